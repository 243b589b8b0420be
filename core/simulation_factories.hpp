// The solvers there are, by shape functions and precision; one file each.
#pragma once

#include "core/simulation.hpp"

namespace scarp {

std::unique_ptr<Simulation> make_linear_simulation(const Scene& scene, const Snapshot* start);
std::unique_ptr<Simulation> make_gimp_simulation(const Scene& scene, const Snapshot* start);
std::unique_ptr<Simulation> make_spline_simulation(const Scene& scene, const Snapshot* start);

// In single precision, with FLIP.
std::unique_ptr<Simulation> make_single_linear_simulation(const Scene& scene,
                                                          const Snapshot* start);
std::unique_ptr<Simulation> make_single_spline_simulation(const Scene& scene,
                                                          const Snapshot* start);

} // namespace scarp
