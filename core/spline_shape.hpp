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

  /// w = (a + b xi) (c + d xi) + e at every node, as products so that small weights are exact.
  class Lanes {
   public:
    explicit Lanes(const StencilCell<Dim>&) : tables_(&unfolded_tables()) {}

    [[gnu::always_inline]] StencilLanes<Dim, power(3, Dim), Number_>
    operator()(const Vec<Dim, Number_>& xi) const {
      const auto term = [&](std::size_t a, std::size_t k) __attribute__((always_inline)) {
        return AtNodes((*tables_)[a][k]);
      };
      const auto line = [&](std::size_t a, std::size_t k) __attribute__((always_inline)) {
        return term(a, k) + term(a, k + 1) * xi[a];
      };
      const auto w = [&](std::size_t a) __attribute__((always_inline)) {
        return line(a, 0) * line(a, 2) + term(a, 4);
      };
      const auto dw = [&](std::size_t a) __attribute__((always_inline)) { return line(a, 5); };
      return {w, dw};
    }

   private:
    using AtNodes = NodeLanes<power(3, Dim), Number_>;
    /// a, b, c, d, e, and of the derivative: b c + a d, 2 b d
    using Coefficients = std::array<typename AtNodes::Table, 7>;
    using Tables = std::array<Coefficients, Dim>; ///< by axis

    static constexpr Tables tables = [] {
      Tables all = {};
      constexpr std::array<std::array<Real, 5>, 3> of_place = {
          {{1.0, -1.0, 0.5, -0.5, 0.0}, {0.0, 1.0, 1.0, -1.0, 0.5}, {0.0, 1.0, 0.0, 0.5, 0.0}}};
      for (std::size_t axis = 0; axis < Dim; ++axis)
        for (std::size_t lane = 0; lane < Stencil<Dim, 3>::nodes; ++lane) {
          const std::size_t node = node_in_lane(lane, Stencil<Dim, 3>::nodes, 3);
          const auto& [a, b, c, d, e] = of_place[Stencil<Dim, 3>::places(node)[axis]];
          const std::array<Real, 7> values = {a, b, c, d, e, b * c + a * d, 2.0 * b * d};
          for (std::size_t k = 0; k < values.size(); ++k)
            all[axis][k][lane] = static_cast<Number_>(values[k]);
        }
      return all;
    }();
    /// Kept from GCC, which takes constants that it knows apart: with AVX-512 in 3-D at a third of
    /// the speed.
    [[gnu::noinline]] static const Tables& unfolded_tables() { return tables; }

    const Tables* tables_;
  };
};

} // namespace scarp
