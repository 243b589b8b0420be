#include "core/linear_shape.hpp"
#include "core/simulation_factories.hpp"
#include "core/simulation_of.hpp"

namespace scarp {

std::unique_ptr<Simulation> make_single_linear_simulation(const Scene& scene,
                                                          const Snapshot* start) {
  return make_simulation_with<LinearShape, float>(scene, start);
}

} // namespace scarp
