// The background grid as arithmetic: cells, nodes, and where a point lies.
#pragma once

#include "core/scene.hpp"
#include "core/types.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace scarp {

/// Index of Vec<Dim>'s axis in the scene's x, y, z.
template <int Dim> constexpr std::size_t scene_axis(int axis) {
  return static_cast<std::size_t>(Dim == 2 && axis == 1 ? 2 : axis);
}

/// Its inverse.
template <int Dim> constexpr std::size_t grid_axis(int scene_axis) {
  return static_cast<std::size_t>(Dim == 2 && scene_axis == 2 ? 1 : scene_axis);
}

/// How the nodes that a point of a cell can reach lie, along each axis.
/// corner: the two ends of the cell (linear functions). padded: these and the next ones on both
/// sides (functions that reach half a point further), with a layer of nodes outside the grid.
/// spline: the middles of the cell and of the next ones on both sides (the control points of
/// quadratic B-splines), with a layer outside the grid.
enum class NodeLayout { corner, padded, spline };

constexpr int stencil_width(NodeLayout layout) {
  return layout == NodeLayout::corner ? 2 : layout == NodeLayout::spline ? 3 : 4;
}

/// width^Dim
constexpr int power(int width, int dim) { return dim == 0 ? 1 : width * power(width, dim - 1); }

/// Regular cells; both cells and nodes are numbered with x fastest.  Along an axis, cell i reaches
/// nodes i to i + width - 1.
template <int Dim> struct GridIndex {
  static constexpr int most_corners = power(4, Dim);

  Vec<Dim> lower;             ///< m
  Real h;                     ///< m, cell size
  Real inv_h;                 ///< 1/m
  std::array<int, Dim> cells; ///< along each axis
  std::array<int, Dim> cell_stride;
  std::array<int, Dim> node_stride;
  NodeLayout layout;
  int width;                  ///< nodes that a cell reaches along an axis
  std::array<int, Dim> nodes; ///< along each axis
  int corners;                ///< nodes that a cell reaches: width^Dim
  /// From a cell's lowest node; corner c is the (c / width^a mod width)-th along axis a.
  std::array<int, most_corners> corner_offset = {};
  int cell_count;
  int node_count;
  /// Whether points cannot pass a side, by axis and side: all but free ones.
  std::array<std::array<bool, 2>, Dim> closed = {};
  /// Whether a side does more than to hold its nodes, by axis and side: see Walls.
  std::array<std::array<bool, 2>, Dim> acts = {};

  explicit GridIndex(const Grid& grid, NodeLayout node_layout = NodeLayout::corner)
      : h(grid.cell_size), inv_h(1.0 / grid.cell_size), layout(node_layout),
        width(stencil_width(node_layout)), corners(power(width, Dim)) {
    cell_count = node_count = 1;
    for (int a = 0; a < Dim; ++a) {
      const auto i = static_cast<std::size_t>(a);
      lower[i] = grid.lower[scene_axis<Dim>(a)];
      cells[i] = static_cast<int>(std::lround((grid.upper[scene_axis<Dim>(a)] - lower[i]) / h));
      cell_stride[i] = cell_count;
      node_stride[i] = node_count;
      cell_count *= cells[i];
      nodes[i] = cells[i] + width - 1;
      node_count *= nodes[i];
      for (std::size_t side = 0; side < 2; ++side) {
        const WallKind kind = grid.walls[scene_axis<Dim>(a)][side].kind;
        closed[i][side] = kind != WallKind::free;
        acts[i][side] =
            kind == WallKind::friction || (layout == NodeLayout::spline && kind != WallKind::free);
      }
    }
    for (int c = 0; c < corners; ++c)
      for (int a = 0, rest = c; a < Dim; ++a, rest /= width)
        corner_offset[static_cast<std::size_t>(c)] +=
            rest % width * node_stride[static_cast<std::size_t>(a)];
  }

  /// The farthest node from a cell's lowest one.
  int reach() const { return corner_offset[static_cast<std::size_t>(corners) - 1]; }

  /// Nodes before a node along an axis.
  int node_along(int node, std::size_t axis) const {
    return node / node_stride[axis] % nodes[axis];
  }

  /// The node itself, or for one in the outermost layers the one next to it inside, along all axes
  /// but `axis`.
  int inside(int node, std::size_t axis) const {
    for (std::size_t i = 0; i < Dim; ++i) {
      const int along = node_along(node, i);
      if (i != axis) node += (std::clamp(along, 1, nodes[i] - 2) - along) * node_stride[i];
    }
    return node;
  }

  /// First and last of the nodes along an axis that hold the velocity on a plane between cells: on
  /// the sides of the grid all that matter there, inside those that do not vanish on the plane.
  std::array<int, 2> nodes_of_plane(std::size_t axis, int plane) const {
    switch (layout) {
    case NodeLayout::corner:
      break;
    case NodeLayout::padded:
      return {plane == 0 ? 0 : plane + 1, plane == cells[axis] ? plane + 2 : plane + 1};
    case NodeLayout::spline:
      return {plane, plane + 1};
    }
    return {plane, plane};
  }

  /// Where the nodes of a side are that has the mean velocity of both: the same one twice, or for
  /// B-splines the one outside the grid and the one inside.  Along the axis; one pair for each
  /// layer of nodes.
  std::vector<std::array<int, 2>> side_layers(std::size_t axis, std::size_t side) const {
    const auto [first, last] = nodes_of_plane(axis, side == 0 ? 0 : cells[axis]);
    if (layout == NodeLayout::spline)
      return {side == 0 ? std::array{first, last} : std::array{last, first}};
    std::vector<std::array<int, 2>> layers;
    for (int layer = first; layer <= last; ++layer) layers.push_back({layer, layer});
    return layers;
  }

  /// Cells before a cell along each axis.
  std::array<int, Dim> along(int cell) const {
    std::array<int, Dim> steps;
    for (std::size_t i = Dim; i-- > 0; cell %= cell_stride[i]) steps[i] = cell / cell_stride[i];
    return steps;
  }

  /// Rows of cells along x before the one of a cell.
  int row_of(const std::array<int, Dim>& steps) const {
    int row = 0;
    for (std::size_t i = 1; i < Dim; ++i) row += steps[i] * (cell_stride[i] / cells[0]);
    return row;
  }

  /// Lowest node of a cell.
  int first_node(int cell) const { return first_node(along(cell)); }
  int first_node(const std::array<int, Dim>& steps) const {
    int node = 0;
    for (std::size_t i = 0; i < Dim; ++i) node += steps[i] * node_stride[i];
    return node;
  }

  /// Position in cells from the lower corner; the cell's own part is xi - floor(xi).
  template <class T> T scaled(const T& x, std::size_t axis) const {
    return (x - lower[axis]) * inv_h;
  }

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
