// State of the background grid's nodes and what the passes over cells leave for them.
#pragma once

#include "core/stencil.hpp"
#include "core/types.hpp"

#include <cmath>
#include <vector>

namespace scarp {

/// What the points of one cell give its corners.  A node adds up the tiles of the cells around it
/// in a fixed order, so no two threads ever write to the same place.
template <int Dim, int corners> struct CellTile {
  using AtNodes = std::array<Real, corners>;
  AtNodes m;                   ///< kg
  AtNodes V0;                  ///< m3, of the unloaded material; only if it is tracked
  std::array<AtNodes, Dim> mv; ///< kg m/s
  std::array<AtNodes, Dim> f;  ///< N, internal
};

template <int Dim> struct NodeState {
  Real m;         ///< kg
  Vec<Dim> inv_m; ///< 1/kg, of what moves with each component; 0 without mass
  Real fraction;  ///< -, see GridState::tracks_fraction
  Vec<Dim> mv;    ///< kg m/s
  Vec<Dim> f;     ///< N
  Vec<Dim> v;     ///< m/s, after the latest constraint
  Vec<Dim> dv;    ///< m/s, change by the forces of this step
  Real damped;    ///< J, taken by local damping in this step
  Real rubbed;    ///< J, taken by friction on walls in this step
};

template <int Dim, class Shape> struct GridState {
  std::vector<CellTile<Dim, Shape::nodes>> tiles; ///< by occupied slot
  std::vector<NodeState<Dim>> nodes; ///< by node index; only active nodes are meaningful

  /// Whether nodes keep the part of their volume that the unloaded material of the points fills.
  bool tracks_fraction;
  std::vector<Real> volume; ///< m3, by node: what belongs to it of the cells around it

  GridState(const GridIndex<Dim>& grid, bool with_fraction)
      : nodes(static_cast<std::size_t>(grid.node_count)), tracks_fraction(with_fraction) {
    if (!tracks_fraction) return;
    volume.assign(nodes.size(), 0.0);
    for (int index = 0; index < grid.cell_count; ++index) {
      const StencilCell<Dim> cell(grid, grid.along(index), 0.0);
      for (std::size_t c = 0; c < Shape::nodes; ++c) {
        const auto k = Shape::places(c);
        Real share = std::pow(grid.h, Dim);
        for (std::size_t a = 0; a < Dim; ++a)
          share *= Shape::shares(cell.first[a], cell.last[a])[k[a]];
        volume[static_cast<std::size_t>(grid.first_node(index) + grid.corner_offset[c])] += share;
      }
    }
  }
};

} // namespace scarp
