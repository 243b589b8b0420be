// Linear (bilinear, trilinear) shape functions of a cell's corners.
#pragma once

#include "core/stencil.hpp"

namespace scarp {

/// Corner c lies on side c >> a & 1 along axis a; xi in [0, 1]^Dim.
template <int Dim, class Number_ = Real> struct LinearShape : Stencil<Dim, 2, Number_> {
  static constexpr NodeLayout layout = NodeLayout::corner;

  LinearShape(const Vec<Dim>& xi, const StencilCell<Dim>& cell) : LinearShape(xi, cell.inv_h) {}
  LinearShape(const Vec<Dim>& xi, Real inv_h) : Stencil<Dim, 2, Number_>(along_axes(xi, inv_h)) {}

  template <class T>
  static AlongAxes<Dim, 2, T> along(const std::array<T, Dim>& xi, const StencilCell<Dim>& cell) {
    return along_axes(xi, cell.inv_h);
  }

  /// Largest slope at a wall, 1/cell.
  static constexpr Real steepest = 1.0;

  /// Of the nodes along an axis, in cells from the cell's lower end.
  static constexpr std::array<Real, 2> positions = {0.0, 1.0};

  /// Parts of a cell's volume that belong to its nodes along an axis.
  static constexpr std::array<Real, 2> shares = {0.5, 0.5};

 private:
  template <class T>
  static AlongAxes<Dim, 2, T> along_axes(const std::array<T, Dim>& xi, Real inv_h) {
    AlongAxes<Dim, 2, T> along;
    for (std::size_t a = 0; a < Dim; ++a) {
      along.w[a] = {1.0F - xi[a], xi[a]};
      along.dw[a] = {T(number<T>(-inv_h)), T(number<T>(inv_h))};
    }
    return along;
  }
};

} // namespace scarp
