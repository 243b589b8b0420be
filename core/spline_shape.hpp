// Quadratic B-splines on an open knot vector: one knot a grid plane, the outermost ones threefold,
// so that the control points on the grid's sides hold the velocity there (Steffen, Kirby & Berzins
// 2008, doi 10.1002/nme.2360; the knot vector as in de Koster et al. 2021,
// doi 10.1007/s40571-020-00346-1).
#pragma once

#include "core/stencil.hpp"

namespace scarp {

/// Cell i, a knot span, reaches control points i, i + 1, i + 2.
template <int Dim, class Number_ = Real> struct SplineShape : Stencil<Dim, 3, Number_> {
  static constexpr NodeLayout layout = NodeLayout::spline;

  SplineShape(const Vec<Dim>& xi, const StencilCell<Dim>& cell)
      : Stencil<Dim, 3, Number_>(along(xi, cell)) {}

  template <class T>
  static AlongAxes<Dim, 3, T> along(const std::array<T, Dim>& xi, const StencilCell<Dim>& cell) {
    AlongAxes<Dim, 3, T> along;
    auto& [w, dw] = along;
    for (std::size_t a = 0; a < Dim; ++a) {
      const auto below = number<T>(cell.first[a] ? 1.0 : 0.5);
      const auto above = number<T>(cell.last[a] ? 1.0 : 0.5);
      const auto twice = number<T>(2.0 * cell.inv_h);
      const T left = 1.0F - xi[a];
      w[a][0] = below * left * left;
      w[a][2] = above * xi[a] * xi[a];
      w[a][1] = 1.0F - w[a][0] - w[a][2];
      dw[a][0] = -twice * below * left;
      dw[a][2] = twice * above * xi[a];
      dw[a][1] = -dw[a][0] - dw[a][2];
    }
    return along;
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

  /// w = (a + b xi) (c + d xi) + e at every node, as products so that small weights are exact.
  class Lanes {
   public:
    explicit Lanes(const StencilCell<Dim>& cell) {
      for (std::size_t a = 0; a < Dim; ++a)
        axis_[a] = &tables[a][(cell.first[a] ? 1U : 0U) + (cell.last[a] ? 2U : 0U)];
    }

    [[gnu::always_inline]] StencilLanes<Dim, power(3, Dim), Number_>
    operator()(const Vec<Dim, Number_>& xi) const {
      const auto term = [&](std::size_t a, std::size_t k) __attribute__((always_inline)) {
        return AtNodes((*axis_[a])[k]);
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

    /// By axis; for cells inside, the first, the last, and the only one along it.
    static constexpr std::array<std::array<Coefficients, 4>, Dim> tables = [] {
      std::array<std::array<Coefficients, 4>, Dim> all = {};
      for (std::size_t axis = 0; axis < Dim; ++axis)
        for (std::size_t side = 0; side < 4; ++side) {
          const Real below = side & 1U ? 1.0 : 0.5;
          const Real above = side & 2U ? 1.0 : 0.5;
          const std::array<std::array<Real, 5>, 3> of_place = {
              {{1.0, -1.0, below, -below, 0.0},
               {0.0, 1.0, 2.0 * below, -below - above, 1.0 - below},
               {0.0, 1.0, 0.0, above, 0.0}}};
          for (std::size_t lane = 0; lane < Stencil<Dim, 3>::nodes; ++lane) {
            const std::size_t node = node_in_lane(lane, Stencil<Dim, 3>::nodes, 3);
            const auto& [a, b, c, d, e] = of_place[Stencil<Dim, 3>::places(node)[axis]];
            const std::array<Real, 7> values = {a, b, c, d, e, b * c + a * d, 2.0 * b * d};
            for (std::size_t k = 0; k < values.size(); ++k)
              all[axis][side][k][lane] = static_cast<Number_>(values[k]);
          }
        }
      return all;
    }();

    std::array<const Coefficients*, Dim> axis_;
  };
};

} // namespace scarp
