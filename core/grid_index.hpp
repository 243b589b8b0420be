// The background grid as arithmetic: cells, nodes, and where a point lies.
#pragma once

#include "core/scene.hpp"
#include "core/types.hpp"

#include <cmath>

namespace scarp {

/// Index of Vec<Dim>'s axis in the scene's x, y, z.
template <int Dim> constexpr std::size_t scene_axis(int axis) {
  return static_cast<std::size_t>(Dim == 2 && axis == 1 ? 2 : axis);
}

/// Its inverse.
template <int Dim> constexpr std::size_t grid_axis(int scene_axis) {
  return static_cast<std::size_t>(Dim == 2 && scene_axis == 2 ? 1 : scene_axis);
}

/// Regular cells; both cells and nodes are numbered with x fastest.
template <int Dim> struct GridIndex {
  static constexpr int corners = 1 << Dim;

  Vec<Dim> lower;             ///< m
  Real h;                     ///< m, cell size
  Real inv_h;                 ///< 1/m
  std::array<int, Dim> cells; ///< along each axis
  std::array<int, Dim> cell_stride;
  std::array<int, Dim> node_stride;
  std::array<int, corners>
      corner_offset; ///< from a cell's lowest node; bit a of the corner: axis a
  int cell_count;
  int node_count;

  explicit GridIndex(const Grid& grid) : h(grid.cell_size), inv_h(1.0 / grid.cell_size) {
    cell_count = node_count = 1;
    for (int a = 0; a < Dim; ++a) {
      const auto i = static_cast<std::size_t>(a);
      lower[i] = grid.lower[scene_axis<Dim>(a)];
      cells[i] = static_cast<int>(std::lround((grid.upper[scene_axis<Dim>(a)] - lower[i]) / h));
      cell_stride[i] = cell_count;
      node_stride[i] = node_count;
      cell_count *= cells[i];
      node_count *= cells[i] + 1;
    }
    for (int c = 0; c < corners; ++c) {
      int offset = 0;
      for (int a = 0; a < Dim; ++a)
        if (c >> a & 1) offset += node_stride[static_cast<std::size_t>(a)];
      corner_offset[static_cast<std::size_t>(c)] = offset;
    }
  }

  /// Lowest node of a cell.
  int first_node(int cell) const {
    int node = 0;
    for (int a = Dim - 1; a >= 0; --a) {
      const auto i = static_cast<std::size_t>(a);
      node += cell / cell_stride[i] * node_stride[i];
      cell %= cell_stride[i];
    }
    return node;
  }

  /// Position in cells from the lower corner; the cell's own part is xi - floor(xi).
  Real scaled(Real x, std::size_t axis) const { return (x - lower[axis]) * inv_h; }

  /// False for NaN as well.
  bool contains(const Vec<Dim>& x) const {
    for (std::size_t i = 0; i < Dim; ++i) {
      const Real xi = scaled(x[i], i);
      if (!(xi >= 0.0 && xi < static_cast<Real>(cells[i]))) return false;
    }
    return true;
  }

  int cell_of(const Vec<Dim>& x) const {
    int cell = 0;
    for (std::size_t i = 0; i < Dim; ++i)
      cell += static_cast<int>(scaled(x[i], i)) * cell_stride[i];
    return cell;
  }
};

} // namespace scarp
