#include "core/compiled_passes.hpp"
#include "core/simulation_factories.hpp"
#include "core/simulation_of.hpp"

namespace scarp {

SCARP_PASSES(template, 2, GimpShape, Real);
SCARP_PASSES(template, 3, GimpShape, Real);

std::unique_ptr<Simulation> make_gimp_simulation(const Scene& scene, const Snapshot* start) {
  return make_simulation_with<GimpShape>(scene, start);
}

} // namespace scarp
