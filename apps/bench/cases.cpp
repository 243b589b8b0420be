#include "apps/bench/cases.hpp"

namespace scarp::bench {

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"bar", "Axial vibration of an elastic bar", bar_case},
      {"column", "Column at rest under its own weight", column_case},
      {"vortex", "Generalised vortex, a manufactured solution", vortex_case},
      {"footing", "Strip footing on soil without friction", footing_case},
      {"stress-paths", "Stress paths of a material point", stress_paths_case},
      {"rotation", "Rotation and objectivity", rotation_case},
      {"block", "Block on an inclined plane with friction", block_case},
      {"rankine", "Active and passive earth pressure", rankine_case},
      {"granular-column", "Collapse of granular columns", granular_column_case},
      {"safety", "Factor of safety of a homogeneous slope", safety_case},
      {"conservation", "Mass, momentum and energy", conservation_case},
      {"grid-independence", "Place and direction of the grid", grid_independence_case},
  };
  return all;
}

} // namespace scarp::bench
