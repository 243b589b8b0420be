// The pile of aluminium rods of Bui et al. 2008 (data/scenes/bui2008.toml), run to its rest: its
// free surface against the experiment's and against that of other runs.
#pragma once

#include "apps/bench/bar.hpp"

#include <cstddef>
#include <vector>

namespace scarp::bench {

constexpr double pile_height = 0.1; // m

struct PileRun {
  std::vector<double> surface; ///< m, height at each x of data/reference/bui2008_surface.csv
  double error;                ///< m, RMS to the experiment, as `reproduce bui2008` has it
  std::size_t points;
  long steps;
};

/// With so many cells over the height.  Scheme, FLIP and settling are the scene's.  Throws what
/// reading its files throws, and RunError.
PileRun collapse_pile(int cells, const Discretisation& how);

} // namespace scarp::bench
