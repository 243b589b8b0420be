#include "core/compiled_passes.hpp"
#include "core/simulation_factories.hpp"
#include "core/simulation_of.hpp"

namespace scarp {

SCARP_PASSES(template, 2, SplineShape, float);
SCARP_PASSES(template, 3, SplineShape, float);

std::unique_ptr<Simulation> make_single_spline_simulation(const Scene& scene,
                                                          const Snapshot* start) {
  return make_simulation_with<SplineShape, float>(scene, start);
}

} // namespace scarp
