// Quadratic B-splines on an open knot vector: one knot a grid plane, the outermost ones threefold,
// so that the control points on the grid's sides hold the velocity there (Steffen, Kirby & Berzins
// 2008, doi 10.1002/nme.2360; the knot vector as in de Koster et al. 2021,
// doi 10.1007/s40571-020-00346-1).
#pragma once

#include "core/stencil.hpp"

namespace scarp {

/// Cell i, a knot span, reaches control points i, i + 1, i + 2.
template <int Dim> struct SplineShape : Stencil<Dim, 3> {
  static constexpr NodeLayout layout = NodeLayout::spline;

  SplineShape(const Vec<Dim>& xi, const StencilCell<Dim>& cell) {
    typename Stencil<Dim, 3>::Along dw;
    auto& weight = this->w;
    for (std::size_t a = 0; a < Dim; ++a) {
      const Real below = cell.first[a] ? 1.0 : 0.5;
      const Real above = cell.last[a] ? 1.0 : 0.5;
      const Real left = 1.0 - xi[a];
      weight[a][0] = below * left * left;
      weight[a][2] = above * xi[a] * xi[a];
      weight[a][1] = 1.0 - weight[a][0] - weight[a][2];
      dw[a][0] = -2.0 * below * left * cell.inv_h;
      dw[a][2] = 2.0 * above * xi[a] * cell.inv_h;
      dw[a][1] = -dw[a][0] - dw[a][2];
    }
    this->multiply(dw);
  }

  /// Largest slope at a wall, 1/cell.
  static constexpr Real steepest = 2.0;

  /// Greville's: sum_k N_k x_k = x.
  static constexpr std::array<Real, 3> positions(bool first, bool last) {
    return {first ? 0.0 : -0.5, 0.5, last ? 1.0 : 1.5};
  }

  /// See core/time_step.hpp: 4 + 4 s^2 / (3/4 - s^2), largest on the planes between cells.
  static Real gradient_bound(Real) { return 6.0; }

  static std::array<Real, 3> shares(bool first, bool last) {
    const Real below = first ? 1.0 / 3.0 : 1.0 / 6.0;
    const Real above = last ? 1.0 / 3.0 : 1.0 / 6.0;
    return {below, 1.0 - below - above, above};
  }
};

} // namespace scarp
