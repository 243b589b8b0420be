// Registers that hold several points, or several nodes, and how points get into them.
#pragma once

#include "core/particles.hpp"

#include <algorithm>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>
#include <utility>

namespace scarp {

/// Several points in the lanes of one register.
using RealPack = std::experimental::native_simd<Real>;

/// Up to RealPack::size() rows of Particles, one a lane.  Nearly all rows follow each other, since
/// the columns are kept nearly in order: what follows each other is read and written at once.
class RowPack {
 public:
  static constexpr std::size_t capacity = RealPack::size();

  [[gnu::always_inline]] RowPack(const std::uint32_t* rows, std::size_t count)
      : first_(rows[0]), count_(count) {
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
    if (!together_) find_pieces(rows);
  }

  std::size_t size() const { return count_; }

  /// Lanes without a point are 0.
  [[gnu::always_inline]] RealPack load(const Column& column) const {
    if (together_) {
      // The processor does not follow as many columns as a pass reads.
      __builtin_prefetch(column.data() + first_ + ahead);
      return RealPack(column.data() + first_, std::experimental::element_aligned);
    }
    RealPack values = 0.0;
    for (std::size_t k = 0; k < pieces_; ++k)
      where(lanes_[k], values)
          .copy_from(column.data() + shift_[k], std::experimental::element_aligned);
    return values;
  }

  [[gnu::always_inline]] void store(const RealPack& values, Column& column) const {
    if (together_)
      return values.copy_to(column.data() + first_, std::experimental::element_aligned);
    for (std::size_t k = 0; k < pieces_; ++k)
      where(lanes_[k], values)
          .copy_to(column.data() + shift_[k], std::experimental::element_aligned);
  }

 private:
  static constexpr std::size_t ahead = 256; ///< rows between reading a column and asking for more

  [[gnu::noinline]] void find_pieces(const std::uint32_t* rows) {
    const RealPack lane([](auto k) { return static_cast<Real>(k); });
    for (std::size_t begin = 0; begin < count_;) {
      std::size_t end = begin + 1;
      while (end < count_ && rows[end] == rows[end - 1] + 1) ++end;
      shift_[pieces_] =
          static_cast<std::ptrdiff_t>(rows[begin]) - static_cast<std::ptrdiff_t>(begin);
      lanes_[pieces_++] = lane >= static_cast<Real>(begin) && lane < static_cast<Real>(end);
      begin = end;
    }
  }

  std::size_t first_, count_;
  bool together_ = false;
  // If not together: the row in lane k is k + shift_, piece by piece.
  std::size_t pieces_ = 0;
  std::array<std::ptrdiff_t, capacity> shift_;
  std::array<RealPack::mask_type, capacity> lanes_;
};

/// n lines of numbers, each with one for every row of a block of cells and room for a whole pack
/// from any row on.
template <int n> class BlockLines {
 public:
  void resize(std::size_t rows) {
    stride_ = rows / RealPack::size() + 2;
    if (lanes_.size() < static_cast<std::size_t>(n) * stride_)
      lanes_.resize(static_cast<std::size_t>(n) * stride_);
  }
  Real* operator[](std::size_t line) { return lanes_[line * stride_].data(); }

 private:
  struct alignas(sizeof(RealPack)) Lanes : std::array<Real, RealPack::size()> {};
  std::vector<Lanes> lanes_;
  std::size_t stride_ = 0;
};

[[gnu::always_inline]] inline RealPack load_lanes(const Real* from) {
  return RealPack(from, std::experimental::element_aligned);
}
[[gnu::always_inline]] inline void store_lanes(const RealPack& values, Real* to) {
  values.copy_to(to, std::experimental::element_aligned);
}

/// Calls visit(0) ... visit(n - 1) with compile-time numbers, so that what they index stays in
/// registers.
template <std::size_t n, class Visit> [[gnu::always_inline]] inline void unrolled(Visit&& visit) {
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    (visit(std::integral_constant<std::size_t, k>()), ...);
  }
  (std::make_index_sequence<n>());
}

/// A number for each of the nodes of a cell, several in a register.
template <int nodes> struct NodeLanes {
  static constexpr std::size_t width = std::min(static_cast<std::size_t>(nodes), RealPack::size());
  static constexpr std::size_t packs = (static_cast<std::size_t>(nodes) + width - 1) / width;
  using Pack = std::experimental::simd<Real, std::experimental::simd_abi::deduce_t<Real, width>>;
  using Table = std::array<Real, packs * width>; ///< constants; those beyond the nodes are 0

  std::array<Pack, packs> pack;

  [[gnu::always_inline]] NodeLanes() {
    unrolled<packs>([&](auto k) { pack[k] = 0.0; });
  }
  [[gnu::always_inline]] explicit NodeLanes(const Table& table) {
    unrolled<packs>([&](auto k) { pack[k] = Pack(&table[k * width], plain); });
  }

  [[gnu::always_inline]] std::array<Real, nodes> values() const {
    std::array<Real, packs * width> all;
    unrolled<packs>([&](auto k) { pack[k].copy_to(&all[k * width], plain); });
    std::array<Real, nodes> some;
    std::copy_n(all.begin(), some.size(), some.begin());
    return some;
  }

  [[gnu::always_inline]] NodeLanes& operator+=(const NodeLanes& b) {
    unrolled<packs>([&](auto k) { pack[k] += b.pack[k]; });
    return *this;
  }
  [[gnu::always_inline]] friend NodeLanes operator+(NodeLanes a, const NodeLanes& b) {
    return a += b;
  }
  [[gnu::always_inline]] friend NodeLanes operator*(NodeLanes a, const NodeLanes& b) {
    unrolled<packs>([&](auto k) { a.pack[k] *= b.pack[k]; });
    return a;
  }
  [[gnu::always_inline]] friend NodeLanes operator*(NodeLanes a, Real b) {
    unrolled<packs>([&](auto k) { a.pack[k] *= Pack(b); });
    return a;
  }

 private:
  static constexpr auto plain = std::experimental::element_aligned;
};

} // namespace scarp
