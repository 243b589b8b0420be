// Registers that hold several points, or several nodes, and how points get into them.
#pragma once

#include "core/particles.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>
#include <utility>

namespace scarp {

/// Several points in the lanes of one register.
template <class T> using Pack = std::experimental::native_simd<T>;

/// The number type of a number, or of a Pack's lanes.
template <class T> struct NumberIn { using type = T; };
template <class T, class Abi> struct NumberIn<std::experimental::simd<T, Abi>> { using type = T; };
/// A constant in the number type of T.
template <class T> constexpr auto number(Real value) {
  return static_cast<typename NumberIn<T>::type>(value);
}

/// Up to Pack<T>::size() rows of Particles, one a lane.  Nearly all rows follow each other, since
/// the columns are kept nearly in order: what follows each other is read and written at once.
template <class T> class RowPack {
 public:
  static constexpr std::size_t capacity = Pack<T>::size();

  [[gnu::always_inline]] RowPack(const std::uint32_t* rows, std::size_t count)
      : rows_(rows), first_(rows[0]), count_(count) {
    using Rows =
        std::experimental::simd<std::uint32_t,
                                std::experimental::simd_abi::deduce_t<std::uint32_t, capacity>>;
    static constexpr auto steps = [] {
      std::array<std::uint32_t, capacity> all = {};
      for (std::uint32_t k = 0; k < capacity; ++k) all[k] = k;
      return all;
    }();
    if (count == capacity) {
      const Rows next = Rows(steps.data(), std::experimental::element_aligned) + rows[0];
      together_ = all_of(Rows(rows, std::experimental::element_aligned) == next);
    }
    if (!together_) find_pieces();
  }

  std::size_t size() const { return count_; }

  /// Lanes without a point are 0.
  [[gnu::always_inline]] Pack<T> load(const ColumnOf<T>& column) const {
    if (together_) {
      // The processor does not follow as many columns as a pass reads.
      __builtin_prefetch(column.data() + first_ + ahead);
      return Pack<T>(column.data() + first_, std::experimental::element_aligned);
    }
    Pack<T> values = 0.0F;
    for (std::size_t k = 0; k < pieces_; ++k)
      where(lanes_[k], values)
          .copy_from(column.data() + shift_[k], std::experimental::element_aligned);
    return values;
  }

  /// value(x) of a column of doubles whatever T is, in T.
  template <class Value>
  [[gnu::always_inline]] Pack<T> map(const Column& column, const Value& value) const {
    if constexpr (std::is_same_v<T, Real>) {
      return value(load(column));
    } else {
      using Wide = std::experimental::rebind_simd_t<Real, Pack<T>>;
      std::array<Real, capacity> values = {};
      if (together_)
        std::copy_n(column.data() + first_, capacity, values.begin());
      else
        for (std::size_t k = 0; k < count_; ++k) values[k] = column[rows_[k]];
      return std::experimental::static_simd_cast<Pack<T>>(
          value(Wide(values.data(), std::experimental::element_aligned)));
    }
  }

  [[gnu::always_inline]] void store(const Pack<T>& values, ColumnOf<T>& column) const {
    if (together_)
      return values.copy_to(column.data() + first_, std::experimental::element_aligned);
    for (std::size_t k = 0; k < pieces_; ++k)
      where(lanes_[k], values)
          .copy_to(column.data() + shift_[k], std::experimental::element_aligned);
  }

 private:
  static constexpr std::size_t ahead = 256; ///< rows between reading a column and asking for more

  [[gnu::noinline]] void find_pieces() {
    const Pack<T> lane([](auto k) { return static_cast<T>(k); });
    for (std::size_t begin = 0; begin < count_;) {
      std::size_t end = begin + 1;
      while (end < count_ && rows_[end] == rows_[end - 1] + 1) ++end;
      shift_[pieces_] =
          static_cast<std::ptrdiff_t>(rows_[begin]) - static_cast<std::ptrdiff_t>(begin);
      lanes_[pieces_++] = lane >= static_cast<T>(begin) && lane < static_cast<T>(end);
      begin = end;
    }
  }

  const std::uint32_t* rows_;
  std::size_t first_, count_;
  bool together_ = false;
  // If not together: the row in lane k is k + shift_, piece by piece.
  std::size_t pieces_ = 0;
  std::array<std::ptrdiff_t, capacity> shift_;
  std::array<typename Pack<T>::mask_type, capacity> lanes_;
};

/// n lines of numbers, each with one for every row of a block of cells and room for a whole pack
/// from any row on.
template <int n, class T> class BlockLines {
 public:
  void resize(std::size_t rows) {
    stride_ = rows / Pack<T>::size() + 2;
    if (lanes_.size() < static_cast<std::size_t>(n) * stride_)
      lanes_.resize(static_cast<std::size_t>(n) * stride_);
  }
  T* operator[](std::size_t line) { return lanes_[line * stride_].data(); }

 private:
  struct alignas(sizeof(Pack<T>)) Lanes : std::array<T, Pack<T>::size()> {};
  std::vector<Lanes> lanes_;
  std::size_t stride_ = 0;
};

template <class T> [[gnu::always_inline]] inline Pack<T> load_lanes(const T* from) {
  return Pack<T>(from, std::experimental::element_aligned);
}
template <class T>
[[gnu::always_inline]] inline void store_lanes(const std::type_identity_t<Pack<T>>& values, T* to) {
  values.copy_to(to, std::experimental::element_aligned);
}

// The lambdas of the passes are always_inline: GCC takes the larger ones out of line, and all
// registers with them through memory.

/// Calls visit(0) ... visit(n - 1) with compile-time numbers, so that what they index stays in
/// registers.
template <std::size_t n, class Visit> [[gnu::always_inline]] inline void unrolled(Visit&& visit) {
  [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
    (visit(std::integral_constant<std::size_t, k>()), ...);
  }
  (std::make_index_sequence<n>());
}

/// A number for each of the nodes of a cell, several in a register.
template <int nodes, class T> struct NodeLanes {
  static constexpr std::size_t width =
      std::min(std::bit_floor(static_cast<std::size_t>(nodes)), Pack<T>::size());
  static constexpr std::size_t packs = (static_cast<std::size_t>(nodes) + width - 1) / width;
  using Lanes = std::experimental::simd<T, std::experimental::simd_abi::deduce_t<T, width>>;
  using Table = std::array<T, packs * width>; ///< constants; those beyond the nodes are 0

  std::array<Lanes, packs> pack;

  [[gnu::always_inline]] NodeLanes() {
    unrolled<packs>([&](auto k) __attribute__((always_inline)) { pack[k] = T(0); });
  }
  [[gnu::always_inline]] explicit NodeLanes(const Table& table) {
    unrolled<packs>([&](auto k) __attribute__((always_inline)) {
      pack[k] = Lanes(&table[k * width], plain);
    });
  }

  [[gnu::always_inline]] std::array<T, nodes> values() const {
    std::array<T, packs * width> all;
    unrolled<packs>([&](auto k) __attribute__((always_inline)) {
      pack[k].copy_to(&all[k * width], plain);
    });
    std::array<T, nodes> some;
    std::copy_n(all.begin(), some.size(), some.begin());
    return some;
  }

  [[gnu::always_inline]] NodeLanes& operator+=(const NodeLanes& b) {
    unrolled<packs>([&](auto k) __attribute__((always_inline)) { pack[k] += b.pack[k]; });
    return *this;
  }
  [[gnu::always_inline]] friend NodeLanes operator+(NodeLanes a, const NodeLanes& b) {
    return a += b;
  }
  [[gnu::always_inline]] friend NodeLanes operator+(NodeLanes a, T b) {
    unrolled<packs>([&](auto k) __attribute__((always_inline)) { a.pack[k] += Lanes(b); });
    return a;
  }
  [[gnu::always_inline]] friend NodeLanes operator*(NodeLanes a, const NodeLanes& b) {
    unrolled<packs>([&](auto k) __attribute__((always_inline)) { a.pack[k] *= b.pack[k]; });
    return a;
  }
  [[gnu::always_inline]] friend NodeLanes operator*(NodeLanes a, T b) {
    unrolled<packs>([&](auto k) __attribute__((always_inline)) { a.pack[k] *= Lanes(b); });
    return a;
  }

 private:
  static constexpr auto plain = std::experimental::element_aligned;
};

} // namespace scarp
