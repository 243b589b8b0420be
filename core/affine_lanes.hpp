// Affine transfers (core/affine.hpp) with nodes, or points, in the lanes of registers.
#pragma once

#include "core/lanes.hpp"
#include "core/stencil.hpp"

namespace scarp {

/// What a point gives the nodes of a cell: m N_I v, or with the velocity's gradient m N_I (v + C
/// r_I).
template <int Dim, class Shape> class MomentumLanes {
  using T = typename Shape::Number;
  using AtNodes = NodeLanes<Shape::nodes, T>;

 public:
  MomentumLanes(const StencilCell<Dim>& cell, bool affine)
      : affine_(affine), h_(number<T>(cell.h)) {
    for (std::size_t a = 0; a < Dim; ++a) place_[a] = AtNodes(places[a]) * h_;
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
  }

 private:
  /// Where the nodes lie along each axis, in cells from the cell's lower end.
  static constexpr std::array<typename AtNodes::Table, Dim> places = [] {
    std::array<typename AtNodes::Table, Dim> all = {};
    for (std::size_t a = 0; a < Dim; ++a)
      for (std::size_t lane = 0; lane < Shape::nodes; ++lane)
        all[a][lane] = static_cast<T>(
            Shape::positions[Shape::places(node_in_lane(lane, Shape::nodes, Shape::width))[a]]);
    return all;
  }();

  bool affine_;
  T h_;
  std::array<AtNodes, Dim> place_;
};

/// q_I along each axis (core/affine.hpp) of several points in a cell, instead of derivatives.
template <int Dim, class Shape, class T>
[[gnu::always_inline]] inline auto affine_functions(const std::array<T, Dim>& xi,
                                                    const AlongAxes<Dim, Shape::width, T>& along,
                                                    const StencilCell<Dim>& cell) {
  if constexpr (Shape::layout == NodeLayout::corner) {
    return along.dw;
  } else {
    auto q = along.w;
    const auto inv_D_h = number<T>(cell.inv_h / Shape::inertia);
    for (std::size_t a = 0; a < Dim; ++a)
      for (std::size_t k = 0; k < Shape::width; ++k)
        q[a][k] *= (number<T>(Shape::positions[k]) - xi[a]) * inv_D_h;
    return q;
  }
}

} // namespace scarp
