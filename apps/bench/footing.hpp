// A rigid rough strip footing pressed into weightless soil without friction, half of it:
//
//   |####|              footing, B/2 wide, sinks at v
//   |----+-------------------
//   |    soil: E, nu, c, phi = 0; Prandtl 1920: load = (2 + pi) c B
//   |
//   +------------------------  2.25 B wide, 1.25 B deep; the mechanism is 1.5 B and 0.71 B
//
// Prandtl's load is that of the body as it lies, so the settlement must stay small: with E/c = 4000
// the limit is reached within 0.4 % of B.  (Measured with E/c = 1000 and 2 % of B: the pressure
// goes on growing by 5 % as points pass into the next cells.)
//
// The footing is a stiff body so heavy that what it loses of its velocity is next to nothing, and
// by which the load is known: M dv/dt.  Its mass is at least a million times that of the soil that
// its nodes share, which holds these nodes as a prescribed velocity would.
#pragma once

#include "apps/bench/bar.hpp"

#include <cstddef>
#include <vector>

namespace scarp::bench {

struct FootingRun {
  std::vector<double> settlement; ///< -, parts of B
  std::vector<double> pressure;   ///< -, load / (c B)
  std::size_t points;
  long steps;

  /// -, mean pressure over the last fifth of the settlement
  double limit() const;
  /// -, of the limit: what the pressure still grows by from the fifth before the last to the last
  double growth() const;
};

constexpr double prandtl = 2.0 + 3.14159265358979323846; // -

/// To a settlement of 0.5 % of B, with so many cells under the whole footing (an even number).
FootingRun press_footing(int cells, const Discretisation& how);

} // namespace scarp::bench
