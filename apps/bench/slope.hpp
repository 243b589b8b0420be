// The surcharged slope of Wu et al. 2017, base case (data/scenes/wu2017.toml), run until it rests.
#pragma once

#include "apps/bench/bar.hpp"

#include <cstddef>

namespace scarp::bench {

struct SlopeRun {
  double peak_energy; ///< J, kinetic, of a slice of 0.5 m as in Wu 2017
  double run_out;     ///< m, front beyond the toe
  std::size_t points;
  long steps;
};

/// m; levels count cells over this length.
constexpr double slope_length = 120.0;

/// At rest: the grid's kinetic energy is below 1 % of its peak, as in data/studies/wu2017.toml, for
/// 0.5 s.  Scheme and FLIP are the scene's.  Throws what reading the scene throws, and RunError.
SlopeRun slide_slope(int cells, const Discretisation& how);

} // namespace scarp::bench
