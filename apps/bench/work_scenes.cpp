#include "apps/bench/work.hpp"

#include <cmath>

namespace scarp::bench {

namespace {

std::vector<int> bar_levels(Effort effort) {
  return effort == Effort::quick ? std::vector{8, 16, 32} : std::vector{8, 16, 32, 64, 128};
}

WorkOutcome run_bar(int cells, const Discretisation& how) {
  constexpr int periods = 3;
  const Vibration vibration = vibrate_bar(cells, periods, how);
  return {std::abs(vibration.frequency_error), vibration.points, vibration.steps};
}

} // namespace

const std::vector<WorkScene>& work_scenes() {
  static const std::vector<WorkScene> all = {
      {"work-bar", "Axial vibration of a bar: error of the frequency over three periods",
       "error of the frequency", bar_levels, [](int cells) { return 1.0 / cells; }, run_bar},
  };
  return all;
}

} // namespace scarp::bench
