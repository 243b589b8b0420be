// What containers hold, in bytes, and where.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace scarp {

/// Begins on a line of the cache, so that registers are loaded from one line each.
template <class T> struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t line{64};

  LineAllocator() = default;
  template <class U> LineAllocator(const LineAllocator<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* from, std::size_t) { ::operator delete(from, line); }
  template <class U> bool operator==(const LineAllocator<U>&) const { return true; }
};

/// A number for every row of points, or for every node.
template <class T> using ColumnOf = std::vector<T, LineAllocator<T>>;

/// Bytes that the vectors have taken, used or not.
template <class... Vectors> std::size_t bytes_of(const Vectors&... vectors) {
  return (std::size_t{0} + ... + (vectors.capacity() * sizeof(typename Vectors::value_type)));
}

} // namespace scarp
