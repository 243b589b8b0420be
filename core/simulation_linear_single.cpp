#include "core/compiled_passes.hpp"
#include "core/simulation_factories.hpp"
#include "core/simulation_of.hpp"

namespace scarp {

SCARP_PASSES(template, 2, LinearShape, float);
SCARP_PASSES(template, 3, LinearShape, float);

std::unique_ptr<Simulation> make_single_linear_simulation(const Scene& scene,
                                                          const Snapshot* start) {
  return make_simulation_with<LinearShape, float>(scene, start);
}

} // namespace scarp
