// State of the background grid's nodes and what the passes over cells leave for them.
#pragma once

#include "core/grid_index.hpp"
#include "core/types.hpp"

#include <vector>

namespace scarp {

/// What the points of one cell give its corners.  A node adds up the tiles of the cells around it
/// in a fixed order, so no two threads ever write to the same place.
template <int Dim> struct CellTile {
  static constexpr int corners = 1 << Dim;
  std::array<Real, corners> m;      ///< kg
  std::array<Vec<Dim>, corners> mv; ///< kg m/s
  std::array<Vec<Dim>, corners> f;  ///< N, internal
};

template <int Dim> struct NodeState {
  Real m;      ///< kg
  Vec<Dim> mv; ///< kg m/s
  Vec<Dim> f;  ///< N
  Vec<Dim> v;  ///< m/s, after the latest constraint
  Vec<Dim> dv; ///< m/s, change by the forces of this step
  Real damped; ///< J, taken by local damping in this step
  Real rubbed; ///< J, taken by friction on walls in this step
};

template <int Dim> struct GridState {
  std::vector<CellTile<Dim>> tiles;  ///< by occupied slot
  std::vector<NodeState<Dim>> nodes; ///< by node index; only active nodes are meaningful

  explicit GridState(const GridIndex<Dim>& grid)
      : nodes(static_cast<std::size_t>(grid.node_count)) {}
};

} // namespace scarp
