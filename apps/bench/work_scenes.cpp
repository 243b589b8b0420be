#include "apps/bench/footing.hpp"
#include "apps/bench/vortex.hpp"
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

std::vector<int> vortex_levels(Effort effort) {
  return effort == Effort::quick ? std::vector{8, 16} : std::vector{8, 16, 32, 64};
}

WorkOutcome run_vortex_scene(int cells, const Discretisation& how) {
  const VortexRun run = run_vortex({}, cells, how);
  return {run.error, run.points, run.steps};
}

std::vector<int> footing_levels(Effort effort) {
  return effort == Effort::quick ? std::vector{8, 16} : std::vector{8, 16, 32};
}

/// The footing's swing is damped by 1 % of PIC where the transfer has a part of FLIP.
WorkOutcome run_footing_scene(int cells, Discretisation how) {
  how.method.flip = 0.99;
  const FootingRun run = press_footing(cells, how);
  return {std::abs(run.limit() / prandtl - 1.0), run.points, run.steps};
}

} // namespace

const std::vector<WorkScene>& work_scenes() {
  static const std::vector<WorkScene> all = {
      {"work-bar", "Axial vibration of a bar: error of the frequency over three periods",
       "error of the frequency", bar_levels, [](int cells) { return 1.0 / cells; }, run_bar},
      {"work-vortex", "Generalised vortex: error of the displacement at the largest turn",
       "relative error in L2", vortex_levels, [](int cells) { return 1.0 / cells; },
       run_vortex_scene},
      {"work-footing", "Strip footing: error of the limit load", "error of the load",
       footing_levels, [](int cells) { return 1.0 / cells; },
       [](int cells, const Discretisation& how) { return run_footing_scene(cells, how); }},
  };
  return all;
}

} // namespace scarp::bench
