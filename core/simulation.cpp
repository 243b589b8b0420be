#include "core/simulation.hpp"

#include "core/simulation_factories.hpp"

namespace scarp {

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Snapshot* start) {
  if (scene.grid.dimension != 2 && scene.grid.dimension != 3)
    throw SetupError("grid.dimension must be 2 or 3");
  switch (scene.method.shape) {
  case ShapeFunctions::gimp:
    return make_gimp_simulation(scene, start);
  case ShapeFunctions::bspline:
    return make_spline_simulation(scene, start);
  case ShapeFunctions::linear:
    break;
  }
  return make_linear_simulation(scene, start);
}

} // namespace scarp
