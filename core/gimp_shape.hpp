// Uniform GIMP: linear functions averaged over the length that a point has at the start
// (Bardenhagen & Kober 2004, CMES 5(6):477-495).
#pragma once

#include "core/stencil.hpp"

#include <algorithm>

namespace scarp {

/// Cell i reaches the nodes of its ends and the next ones on both sides: i to i + 3, of which node
/// 1 lies on the grid's lower side.
template <int Dim, class Number_ = Real> struct GimpShape : Stencil<Dim, 4> {
  static constexpr NodeLayout layout = NodeLayout::padded;

  GimpShape(const Vec<Dim>& xi, const StencilCell<Dim>& cell) : Stencil<Dim, 4>(along(xi, cell)) {}

  template <class T>
  static AlongAxes<Dim, 4, T> along(const std::array<T, Dim>& xi, const StencilCell<Dim>& cell) {
    using std::max;
    AlongAxes<Dim, 4, T> along;
    auto& [weight, dw] = along;
    for (std::size_t a = 0; a < Dim; ++a) {
      // The part of the point beyond the cell's ends, in cells, and the squares that its averages
      // take: int of the hats over [xi - l, xi + l] / 2 l.
      const Real l = cell.half_point;
      const T below = max(l - xi[a], T(0.0));
      const T above = max(l - (1.0 - xi[a]), T(0.0));
      const Real scale = 1.0 / (4.0 * l);
      weight[a][0] = below * below * scale;
      weight[a][3] = above * above * scale;
      // Linear reproduction, sum_k N_k = 1 and sum_k N_k x_k = xi, gives the other two.
      weight[a][2] = xi[a] + weight[a][0] - 2.0 * weight[a][3];
      weight[a][1] = 1.0 - weight[a][0] - weight[a][2] - weight[a][3];
      const Real slope = 2.0 * scale * cell.inv_h;
      dw[a][0] = -below * slope;
      dw[a][3] = above * slope;
      dw[a][2] = cell.inv_h + dw[a][0] - 2.0 * dw[a][3];
      dw[a][1] = -dw[a][0] - dw[a][2] - dw[a][3];
    }
    return along;
  }

  /// Largest slope at a wall, 1/cell.
  static constexpr Real steepest = 1.0;

  static constexpr std::array<Real, 4> positions = {-1.0, 0.0, 1.0, 2.0};

  /// See core/time_step.hpp: 1/l for each function that a point's end cuts, l half its length.
  static Real gradient_bound(Real half_point) {
    return 2.0 / half_point + 1.0 / (1.0 - half_point);
  }

  /// The body's part of a node is that of the linear function: averaging over points that fill it
  /// changes nothing.
  static constexpr std::array<Real, 4> shares = {0.0, 0.5, 0.5, 0.0};
};

} // namespace scarp
