// Axial vibration of an elastic bar between smooth sides, held at x = 0 and free at x = L:
//
//   |#######################        v(x, 0) = V sin(pi x / 2L)
//   0                      L
//
// Plane strain with nu = 0, so the modulus is E, the wave speed c = sqrt(E / rho), and the lowest
// mode has f = c / 4L.
#pragma once

#include "core/scene.hpp"

namespace scarp::bench {

/// A way to compute, beside the cell size.
struct Discretisation {
  Method method = {};
  int points_per_cell = 2; ///< along an axis
  double cfl = 0.3;
};

struct Vibration {
  double frequency_error; ///< -, of f
  double energy_drift;    ///< -, mean energy of the last period over that of the first, less 1
  std::size_t points;
  long steps;
};

/// So many periods, which end where the velocity along the mode passes 0 downwards.
Vibration vibrate_bar(int cells, int periods, const Discretisation& how);

} // namespace scarp::bench
