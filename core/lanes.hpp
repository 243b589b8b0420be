// Registers that hold several points, or several nodes, and how points get into them.
#pragma once

#include "core/particles.hpp"

#include <algorithm>
#include <cstdint>
#include <experimental/simd>

namespace scarp {

/// Several points in the lanes of one register.
using RealPack = std::experimental::native_simd<Real>;

/// Up to RealPack::size() rows of Particles, one a lane.  Rows that follow each other, as nearly
/// all do since the columns are kept nearly in order, are read and written at once.
class RowPack {
 public:
  static constexpr std::size_t capacity = RealPack::size();

  [[gnu::always_inline]] RowPack(const std::uint32_t* rows, std::size_t count)
      : rows_(rows), count_(count) {
    using Rows = std::experimental::simd<
        std::uint32_t, std::experimental::simd_abi::deduce_t<std::uint32_t, capacity>>;
    if (count < capacity) return;
    const Rows next([&](auto k) { return rows[0] + static_cast<std::uint32_t>(k); });
    together_ = all_of(Rows(rows, std::experimental::element_aligned) == next);
  }

  std::size_t size() const { return count_; }

  /// Lanes without a point are 0.
  [[gnu::always_inline]] RealPack load(const Column& column) const {
    if (together_) {
      __builtin_prefetch(column.data() + rows_[0] + 256);
      return RealPack(&column[rows_[0]], std::experimental::element_aligned);
    }
    std::array<Real, capacity> values = {};
    for (std::size_t k = 0; k < count_; ++k) values[k] = column[rows_[k]];
    return RealPack(values.data(), std::experimental::element_aligned);
  }

  [[gnu::always_inline]] void store(const RealPack& values, Column& column) const {
    if (together_) return values.copy_to(&column[rows_[0]], std::experimental::element_aligned);
    std::array<Real, capacity> lanes;
    values.copy_to(lanes.data(), std::experimental::element_aligned);
    for (std::size_t k = 0; k < count_; ++k) column[rows_[k]] = lanes[k];
  }

 private:
  const std::uint32_t* rows_;
  std::size_t count_;
  bool together_ = false;
};

/// n lines of numbers, each with one for every row of a block of cells and room for a whole pack
/// from any row on.
template <int n> class BlockLines {
 public:
  void resize(std::size_t rows) {
    stride_ = rows / RealPack::size() + 2;
    if (lanes_.size() < static_cast<std::size_t>(n) * stride_) lanes_.resize(static_cast<std::size_t>(n) * stride_);
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

/// A number for each of the nodes of a cell, several in a register.
template <int nodes> struct NodeLanes {
  static constexpr std::size_t width =
      std::min(static_cast<std::size_t>(nodes), RealPack::size());
  static constexpr std::size_t packs = (static_cast<std::size_t>(nodes) + width - 1) / width;
  using Pack = std::experimental::simd<Real, std::experimental::simd_abi::deduce_t<Real, width>>;
  using Table = std::array<Real, packs * width>; ///< constants; those beyond the nodes are 0

  std::array<Pack, packs> pack;

  NodeLanes() { pack.fill(Pack(0.0)); }

  explicit NodeLanes(const Table& table) {
    for (std::size_t k = 0; k < packs; ++k)
      pack[k].copy_from(&table[k * width], std::experimental::element_aligned);
  }

  void store(std::array<Real, nodes>& values) const {
    for (std::size_t k = 0; k < packs; ++k)
      if ((k + 1) * width <= nodes)
        pack[k].copy_to(&values[k * width], std::experimental::element_aligned);
      else
        for (std::size_t c = k * width; c < nodes; ++c) values[c] = pack[k][c - k * width];
  }

  NodeLanes& operator+=(const NodeLanes& b) {
    for (std::size_t k = 0; k < packs; ++k) pack[k] += b.pack[k];
    return *this;
  }
  friend NodeLanes operator+(NodeLanes a, const NodeLanes& b) { return a += b; }
  friend NodeLanes operator*(NodeLanes a, const NodeLanes& b) {
    for (std::size_t k = 0; k < packs; ++k) a.pack[k] *= b.pack[k];
    return a;
  }
  friend NodeLanes operator*(NodeLanes a, Real b) {
    for (std::size_t k = 0; k < packs; ++k) a.pack[k] *= Pack(b);
    return a;
  }
};

} // namespace scarp
