// Scenes made by hand, and runs that begin from a state made by hand.
#pragma once

#include "apps/bench/bar.hpp"

#include "core/simulation.hpp"

#include <array>
#include <functional>
#include <memory>
#include <string>

namespace scarp::bench {

Region box(const std::string& name, const std::string& material, std::array<double, 2> lower,
           std::array<double, 2> upper);

/// Plane strain with free sides, from (x0, z0) to (x1, z1), m.
Grid plane_grid(double cell_size, std::array<double, 2> lower, std::array<double, 2> upper);

/// "grains": cohesionless, friction angle of 30 degrees, plane-strain cone, gaps remembered.
Material grains();

/// Gives a scene from a file another way to compute, of which scheme, FLIP and settling stay the
/// file's.  The grid's upper corner goes out to whole cells.
void discretise(Scene& scene, double cell_size, const Discretisation& how);

/// The points of a simulation that has not begun, free of stress.
Snapshot at_rest(const Simulation& simulation);

/// At time 0 from a state made by hand.
std::unique_ptr<Simulation> begin_from(Scene scene, const Snapshot& start);

/// At time 0, with what `change` makes of velocities, stresses and so on.
std::unique_ptr<Simulation> begin_with(Scene scene, const std::function<void(Snapshot&)>& change);

/// kg of each point, per metre of depth in plane strain.
std::vector<double> masses(const Simulation& simulation);

/// Steps to `time` (s), unless that has come.
void run_until(Simulation& simulation, double time);

} // namespace scarp::bench
