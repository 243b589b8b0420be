#include "core/simulation_factories.hpp"
#include "core/simulation_of.hpp"
#include "core/spline_shape.hpp"

namespace scarp {

std::unique_ptr<Simulation> make_single_spline_simulation(const Scene& scene,
                                                          const Snapshot* start) {
  return make_simulation_with<SplineShape, float>(scene, start);
}

} // namespace scarp
