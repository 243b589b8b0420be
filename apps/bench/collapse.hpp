// The scene of `scarp bench speed`: a block of rods that has begun to collapse and yields in nearly
// every point, at any number of points.
#pragma once

#include "core/simulation.hpp"

#include <memory>

namespace scarp::bench {

struct CollapseSize {
  int dimension = 2;
  int cells_high = 1;

  std::size_t points() const;
};

/// The size with the number of points nearest to this one.
CollapseSize collapse_of(int dimension, double points);

/// Twice as long as high, in 3-D as deep as high between smooth sides; against a smooth wall on a
/// fixed base, 2 points a cell along each axis, MUSL, Drucker-Prager (the rods of Bui et al. 2008,
/// which remember gaps).  0.2 m high whatever the cells.  `method` says shape and transfer.
Scene collapse_scene(const CollapseSize& size, const Method& method);

/// The stress of an active wedge, on the cone, and the motion of a slump that spreads by half a
/// metre a second at its front: from the first step on points yield and change cells as they do in
/// a collapse.
Snapshot collapse_start(const CollapseSize& size);

std::unique_ptr<Simulation> begin_collapse(const CollapseSize& size, const Method& method,
                                           const Snapshot& start);

/// Part of the points that have yielded.
double yielded_part(const Simulation& simulation);

} // namespace scarp::bench
