// The nodes that a point reaches and its weights there: products of functions along the axes.
#pragma once

#include "core/grid_index.hpp"
#include "core/types.hpp"

namespace scarp {

/// What the points of a cell share in their shape functions.
template <int Dim> struct StencilCell {
  Vec<Dim> corner;             ///< lowest corner, in cells from the grid's lower corner
  Real h;                      ///< m
  Real inv_h;                  ///< 1/m
  Real half_point;             ///< half the length of a point, in cells
  std::array<bool, Dim> first; ///< whether the cell is the grid's first along an axis
  std::array<bool, Dim> last;
  /// See GridIndex: of the sides that the cell lies at.
  std::array<std::array<std::uint8_t, 2>, Dim> odd;

  StencilCell(const GridIndex<Dim>& grid, int cell, Real half_point_length)
      : h(grid.h), inv_h(grid.inv_h), half_point(half_point_length) {
    for (int a = Dim - 1; a >= 0; --a) {
      const auto i = static_cast<std::size_t>(a);
      const int along = cell / grid.cell_stride[i];
      corner[i] = along;
      first[i] = along == 0;
      last[i] = along + 1 == grid.cells[i];
      odd[i][0] = first[i] ? grid.odd[i][0] : std::uint8_t{0};
      odd[i][1] = last[i] ? grid.odd[i][1] : std::uint8_t{0};
      cell %= grid.cell_stride[i];
    }
  }
};

/// N and grad N (1/m) at the width^Dim nodes of a cell, x fastest.
template <int Dim, int width> struct Stencil {
  static constexpr int nodes = power(width, Dim);
  using Along = std::array<std::array<Real, width>, Dim>; ///< by axis
  std::array<Real, nodes> N;
  std::array<Vec<Dim>, nodes> dN;
  Along w; ///< N is the product of these

 protected:
  void multiply(const Along& dw) {
    for (std::size_t c = 0; c < nodes; ++c) {
      const std::array<std::size_t, Dim> k = places(c);
      Real product = 1.0;
      for (std::size_t a = 0; a < Dim; ++a) product *= w[a][k[a]];
      N[c] = product;
      for (std::size_t a = 0; a < Dim; ++a) {
        Real slope = dw[a][k[a]];
        for (std::size_t b = 0; b < Dim; ++b)
          if (b != a) slope *= w[b][k[b]];
        dN[c][a] = slope;
      }
    }
  }

 public:
  /// Place of node c along each axis.
  static constexpr std::array<std::size_t, Dim> places(std::size_t c) {
    std::array<std::size_t, Dim> k = {};
    for (std::size_t a = 0; a < Dim; ++a, c /= width) k[a] = c % width;
    return k;
  }
};

} // namespace scarp
