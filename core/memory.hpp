// What containers hold, in bytes, and where.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#include <sys/mman.h>

namespace scarp {

/// Begins on a line of the cache, so that registers are loaded from one line each.  What is large
/// has the system's large pages if it gives any: points that change cell touch all columns, each on
/// another page (15 % of a step at 10^7 points).
template <class T> struct LineAllocator {
  using value_type = T;
  static constexpr std::size_t line = 64, page = std::size_t{1} << 21; // bytes
  static constexpr bool large(std::size_t n) { return n * sizeof(T) >= 2 * page; }
  static constexpr std::align_val_t alignment(std::size_t n) {
    return std::align_val_t{large(n) ? page : line};
  }

  LineAllocator() = default;
  template <class U> LineAllocator(const LineAllocator<U>&) {}

  T* allocate(std::size_t n) {
    void* to = ::operator new(n * sizeof(T), alignment(n));
    if (large(n)) ::madvise(to, n * sizeof(T), MADV_HUGEPAGE); // a wish: no matter if it fails
    return static_cast<T*>(to);
  }
  void deallocate(T* from, std::size_t n) { ::operator delete(from, alignment(n)); }
  template <class U> bool operator==(const LineAllocator<U>&) const { return true; }
};

/// A number for every row of points, or for every node.
template <class T> using ColumnOf = std::vector<T, LineAllocator<T>>;

/// Resizes, with some room for more if it has to move; vectors alone would take twice the memory.
template <class Vector>
void grow(Vector& vector, std::size_t size, const typename Vector::value_type& value = {}) {
  if (size > vector.capacity()) vector.reserve(size + size / 64);
  vector.resize(size, value);
}

/// Bytes that the vectors have taken, used or not.
template <class... Vectors> std::size_t bytes_of(const Vectors&... vectors) {
  return (std::size_t{0} + ... + (vectors.capacity() * sizeof(typename Vectors::value_type)));
}

} // namespace scarp
