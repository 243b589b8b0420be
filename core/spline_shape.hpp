// Quadratic B-splines on equal knots, one a grid plane: control points in the middles of the cells
// and, as in Steffen, Kirby & Berzins 2008 (doi 10.1002/nme.2360), a layer of them outside the
// grid. All cells have the same functions; what a side does to the control points beyond it is left
// to core/walls.hpp, so that no function is steeper at a side than inside.
#pragma once

#include "core/stencil.hpp"

namespace scarp {

/// Cell i, a knot span, reaches control points i, i + 1, i + 2; i + 1 lies in its middle.
template <int Dim, class Number_ = Real> struct SplineShape : Stencil<Dim, 3, Number_> {
  static constexpr NodeLayout layout = NodeLayout::spline;

  SplineShape(const Vec<Dim>& xi, const StencilCell<Dim>& cell)
      : Stencil<Dim, 3, Number_>(along(xi, cell)) {}

  template <class T>
  static AlongAxes<Dim, 3, T> along(const std::array<T, Dim>& xi, const StencilCell<Dim>& cell) {
    AlongAxes<Dim, 3, T> along;
    auto& [w, dw] = along;
    const auto inv_h = number<T>(cell.inv_h);
    for (std::size_t a = 0; a < Dim; ++a) {
      const T left = 1.0F - xi[a];
      w[a][0] = 0.5F * left * left;
      w[a][2] = 0.5F * xi[a] * xi[a];
      w[a][1] = 0.5F + xi[a] * left;
      dw[a][0] = -inv_h * left;
      dw[a][2] = inv_h * xi[a];
      dw[a][1] = -dw[a][0] - dw[a][2];
    }
    return along;
  }

  /// Largest slope at a wall, 1/cell: of a control point and its image (core/walls.hpp).
  static constexpr Real steepest = 2.0;

  /// Of the nodes along an axis, in cells from the cell's lower end: sum_k N_k x_k = x.
  static constexpr std::array<Real, 3> positions = {-0.5, 0.5, 1.5};

  /// sum_k N_k (x_k - x)^2 along an axis, in cells^2, the same everywhere.
  static constexpr Real inertia = 0.25;

  /// See core/time_step.hpp: 4 + 4 s^2 / (3/4 - s^2), largest on the planes between cells.
  static Real gradient_bound(Real) { return 6.0; }

  /// Parts of a cell's volume that belong to its nodes along an axis.
  static constexpr std::array<Real, 3> shares = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};
};

} // namespace scarp
