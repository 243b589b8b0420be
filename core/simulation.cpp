#include "core/simulation.hpp"

#include "core/simulation_factories.hpp"

namespace scarp {

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Snapshot* start) {
  if (scene.grid.dimension != 2 && scene.grid.dimension != 3)
    throw SetupError("grid.dimension must be 2 or 3");
  if (scene.method.precision == Precision::single) {
    if (scene.method.shape == ShapeFunctions::gimp)
      throw SetupError("single precision goes with linear functions and B-splines only");
    return scene.method.shape == ShapeFunctions::linear
               ? make_single_linear_simulation(scene, start)
               : make_single_spline_simulation(scene, start);
  }
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
