#include "core/gimp_shape.hpp"
#include "core/simulation_factories.hpp"
#include "core/simulation_of.hpp"

namespace scarp {

std::unique_ptr<Simulation> make_gimp_simulation(const Scene& scene, const Snapshot* start) {
  return make_simulation_with<GimpShape>(scene, start);
}

} // namespace scarp
