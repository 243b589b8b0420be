#include "core/compiled_passes.hpp"
#include "core/simulation_factories.hpp"
#include "core/simulation_of.hpp"

namespace scarp {

SCARP_PASSES(template, 2, LinearShape, Real);
SCARP_PASSES(template, 3, LinearShape, Real);

std::unique_ptr<Simulation> make_linear_simulation(const Scene& scene, const Snapshot* start) {
  return make_simulation_with<LinearShape>(scene, start);
}

} // namespace scarp
