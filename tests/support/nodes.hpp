// The nodes that a step touches.
#pragma once

#include "core/state.hpp"

#include <vector>

namespace scarp::test {

template <int Dim, class Shape> std::vector<int> active_nodes(const State<Dim, Shape>& state) {
  std::vector<int> nodes;
  for (const auto& run : state.order.node_runs())
    for (int k = 0; k < static_cast<int>(run.count); ++k) nodes.push_back(run.node + k);
  return nodes;
}

/// By node, what all tiles give.
template <int Dim, class Shape>
std::vector<double> by_node(const State<Dim, Shape>& state,
                            const typename TileSums<Dim, Shape>::Lines& lines) {
  const auto& tiles = state.order.tiles();
  std::vector<double> sums(state.nodal.nodes.m.size() + 16, 0.0);
  for (std::size_t tile = 0; tile < tiles.size(); ++tile)
    for (std::size_t line = 0; line < lines.size(); ++line)
      for (std::size_t e = 0; e < state.order.tile_entries; ++e)
        sums[static_cast<std::size_t>(tiles[tile].first_node +
                                      state.grid.corner_offset[line * Shape::width]) +
             e] += lines[line][state.order.entry(tile) + e];
  sums.resize(static_cast<std::size_t>(state.grid.node_count));
  return sums;
}

} // namespace scarp::test
