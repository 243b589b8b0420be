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

} // namespace scarp::test
