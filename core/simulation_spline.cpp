#include "core/compiled_passes.hpp"
#include "core/simulation_factories.hpp"
#include "core/simulation_of.hpp"

namespace scarp {

SCARP_PASSES(template, 2, SplineShape, Real);
SCARP_PASSES(template, 3, SplineShape, Real);

std::unique_ptr<Simulation> make_spline_simulation(const Scene& scene, const Snapshot* start) {
  return make_simulation_with<SplineShape>(scene, start);
}

} // namespace scarp
