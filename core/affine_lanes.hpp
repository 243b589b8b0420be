// Affine transfers (core/affine.hpp) with nodes, or points, in the lanes of registers.
#pragma once

#include "core/lanes.hpp"
#include "core/stencil.hpp"

#include <limits>

namespace scarp {

/// What a point gives the nodes of a cell: m N_I v, or with the velocity's gradient m N_I (v + C
/// r_I).
template <int Dim, class Shape> class MomentumLanes {
  using T = typename Shape::Number;
  using AtNodes = NodeLanes<Shape::nodes, T>;

 public:
  MomentumLanes(const StencilCell<Dim>& cell, bool affine) : affine_(affine) {
    if (!affine) return;
    h_ = number<T>(cell.h);
    for (std::size_t a = 0; a < Dim; ++a) {
      const std::size_t sides = (cell.first[a] ? 1U : 0U) + (cell.last[a] ? 2U : 0U);
      place_[a] = AtNodes(places[a][sides]) * h_;
      mirrored_ = mirrored_ || cell.odd[a][0] != 0 || cell.odd[a][1] != 0;
    }
    if (mirrored_) odd_ = cell.odd;
  }

  /// mv_i += ... of the point in line k, with N at its place xi; m_C[Dim i + j] = m C_ij.
  [[gnu::always_inline]] void add(std::array<AtNodes, Dim>& mv, const AtNodes& N,
                                  const Vec<Dim, T>& xi, BlockLines<Dim, T>& m_v,
                                  BlockLines<Dim * Dim, T>& m_C, std::size_t k) const {
    if (!affine_) {
      for (std::size_t i = 0; i < Dim; ++i) mv[i] += N * m_v[i][k];
      return;
    }
    std::array<AtNodes, Dim> r;
    for (std::size_t a = 0; a < Dim; ++a) r[a] = place_[a] + -h_ * xi[a];
    for (std::size_t i = 0; i < Dim; ++i) {
      AtNodes momentum = r[0] * m_C[Dim * i][k];
      for (std::size_t j = 1; j < Dim; ++j) momentum += r[j] * m_C[Dim * i + j][k];
      mv[i] += N * (momentum + m_v[i][k]);
    }
    if (mirrored_) add_mirrored(mv, N, m_C, k);
  }

 private:
  /// Next to a mirror: see add_affine_momentum in core/affine.hpp.  N of the held node, w_j(0) or
  /// w_j(2), counts for the one beside it, w_j(1).
  [[gnu::noinline]] void add_mirrored(std::array<AtNodes, Dim>& mv, const AtNodes& N,
                                      BlockLines<Dim * Dim, T>& m_C, std::size_t k) const {
    if constexpr (Shape::layout == NodeLayout::spline) {
      const std::array<T, Shape::nodes> at = N.values();
      for (std::size_t j = 0; j < Dim; ++j) {
        for (const std::size_t side : {0U, 1U}) {
          if (odd_[j][side] == 0) continue;
          typename AtNodes::Table moved = {};
          for (std::size_t lane = 0; lane < Shape::nodes; ++lane) {
            auto place = Shape::places(node_in_lane(lane, Shape::nodes, Shape::width));
            if (place[j] != 1) continue;
            place[j] = side == 0 ? 0 : 2;
            moved[lane] = at[lane_of(place)];
          }
          const T half = (side == 0 ? T(0.5) : T(-0.5)) * h_;
          for (std::size_t i = 0; i < Dim; ++i)
            if (odd_[j][side] >> i & 1U) mv[i] += AtNodes(moved) * (half * m_C[Dim * i + j][k]);
        }
      }
    }
  }

  static constexpr std::size_t lane_of(const std::array<std::size_t, Dim>& place) {
    std::size_t line = 0;
    for (std::size_t a = Dim; a-- > 1;) line = line * Shape::width + place[a];
    return place[0] * (Shape::nodes / Shape::width) + line;
  }

  /// Where the nodes lie along each axis, in cells from the cell's lower end; for cells inside, the
  /// first, the last, and the only one along it.
  static constexpr std::array<std::array<typename AtNodes::Table, 4>, Dim> places = [] {
    std::array<std::array<typename AtNodes::Table, 4>, Dim> all = {};
    for (std::size_t a = 0; a < Dim; ++a)
      for (std::size_t sides = 0; sides < 4; ++sides)
        for (std::size_t lane = 0; lane < Shape::nodes; ++lane)
          all[a][sides][lane] = static_cast<T>(Shape::positions(
              sides & 1U,
              sides & 2U)[Shape::places(node_in_lane(lane, Shape::nodes, Shape::width))[a]]);
    return all;
  }();

  bool affine_;
  bool mirrored_ = false;
  T h_ = 0;
  std::array<AtNodes, Dim> place_;
  std::array<std::array<std::uint8_t, 2>, Dim> odd_ = {};
};

/// q_I along each axis (core/affine.hpp) of several points in a cell, instead of derivatives.
template <int Dim, class Shape, class T>
[[gnu::always_inline]] inline auto affine_functions(const std::array<T, Dim>& xi,
                                                    const AlongAxes<Dim, Shape::width, T>& along,
                                                    const StencilCell<Dim>& cell) {
  if constexpr (Shape::layout == NodeLayout::corner) {
    return along.dw;
  } else {
    using std::max;
    constexpr auto least = std::numeric_limits<typename NumberIn<T>::type>::min();
    const auto h = number<T>(cell.h);
    auto q = along.w;
    for (std::size_t a = 0; a < Dim; ++a) {
      const auto places = Shape::positions(cell.first[a], cell.last[a]);
      T D = 0.0F;
      for (std::size_t k = 0; k < Shape::width; ++k) {
        const T r = (number<T>(places[k]) - xi[a]) * h;
        q[a][k] *= r;
        D += q[a][k] * r;
      }
      const T inv_D = 1.0F / max(D, T(least));
      for (std::size_t k = 0; k < Shape::width; ++k) q[a][k] *= inv_D;
    }
    return q;
  }
}

} // namespace scarp
