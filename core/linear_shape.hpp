// Linear (bilinear, trilinear) shape functions of a cell's corners.
#pragma once

#include "core/stencil.hpp"

namespace scarp {

/// Corner c lies on side c >> a & 1 along axis a; xi in [0, 1]^Dim.
template <int Dim> struct LinearShape : Stencil<Dim, 2> {
  static constexpr NodeLayout layout = NodeLayout::corner;

  LinearShape(const Vec<Dim>& xi, const StencilCell<Dim>& cell) : LinearShape(xi, cell.inv_h) {}

  LinearShape(const Vec<Dim>& xi, Real inv_h) {
    typename Stencil<Dim, 2>::Along dw;
    auto& weight = this->w;
    for (std::size_t a = 0; a < Dim; ++a) {
      weight[a] = {1.0 - xi[a], xi[a]};
      dw[a] = {-inv_h, inv_h};
    }
    this->multiply(dw);
  }

  /// Largest slope at a wall, 1/cell.
  static constexpr Real steepest = 1.0;

  /// Of the nodes along an axis, in cells from the cell's lower end.
  static constexpr std::array<Real, 2> positions(bool, bool) { return {0.0, 1.0}; }

  /// Parts of a cell's volume that belong to its nodes along an axis.
  static std::array<Real, 2> shares(bool, bool) { return {0.5, 0.5}; }
};

} // namespace scarp
