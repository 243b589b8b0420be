#include "apps/bench/footing.hpp"
#include "apps/bench/pile.hpp"
#include "apps/bench/slope.hpp"
#include "apps/bench/vortex.hpp"
#include "apps/bench/work.hpp"

#include <cmath>
#include <limits>

namespace scarp::bench {

namespace {

std::vector<WorkPlan> plan_bar(Effort effort) {
  return every_method(effort, effort == Effort::quick ? std::vector{8, 16, 32}
                                                      : std::vector{8, 16, 32, 64, 128});
}

WorkOutcome run_bar(int cells, const Discretisation& how) {
  constexpr int periods = 3;
  const Vibration vibration = vibrate_bar(cells, periods, how);
  return {std::abs(vibration.frequency_error), vibration.points, vibration.steps};
}

std::vector<WorkPlan> plan_vortex(Effort effort) {
  return every_method(effort,
                      effort == Effort::quick ? std::vector{8, 16} : std::vector{8, 16, 32, 64});
}

WorkOutcome run_vortex_scene(int cells, const Discretisation& how) {
  const VortexRun run = run_vortex({}, cells, how);
  return {run.error, run.points, run.steps};
}

std::vector<WorkPlan> plan_footing(Effort effort) {
  return every_method(effort,
                      effort == Effort::quick ? std::vector{8, 16} : std::vector{8, 16, 32});
}

/// The footing's swing is damped by 1 % of PIC where the transfer has a part of FLIP.
WorkOutcome run_footing_scene(int cells, Discretisation how) {
  how.method.flip = 0.99;
  const FootingRun run = press_footing(cells, how);
  return {std::abs(run.limit() / prandtl - 1.0), run.points, run.steps};
}

/// 10 and 5 mm, with all effort 2.5 mm.
std::vector<WorkPlan> plan_pile(Effort effort) {
  return landslide_methods(effort,
                           effort == Effort::quick ? std::vector{10, 20} : std::vector{10, 20, 40});
}

WorkOutcome run_pile(int cells, const Discretisation& how) {
  PileRun run = collapse_pile(cells, how);
  for (double& height : run.surface) height /= pile_height;
  return {run.error / pile_height, run.points, run.steps, run.surface};
}

/// 2 and 1 m, with all effort 0.5 m and, for the presets, 0.25 m.
std::vector<WorkPlan> plan_slope(Effort effort) {
  if (effort == Effort::quick) return landslide_methods(effort, {60, 120});
  return landslide_methods(effort, {60, 120, 240}, 480);
}

WorkOutcome run_slope(int cells, const Discretisation& how) {
  constexpr double nobody_knows = std::numeric_limits<double>::quiet_NaN();
  const SlopeRun run = slide_slope(cells, how);
  return {nobody_knows, run.points, run.steps, {1e-3 * run.peak_energy, run.run_out}};
}

} // namespace

const std::vector<WorkScene>& work_scenes() {
  static const std::vector<WorkScene> all = {
      {"work-bar", "Axial vibration of a bar: error of the frequency over three periods",
       "error of the frequency", plan_bar, [](int cells) { return 1.0 / cells; }, run_bar},
      {"work-vortex", "Generalised vortex: error of the displacement at the largest turn",
       "relative error in L2", plan_vortex, [](int cells) { return 1.0 / cells; },
       run_vortex_scene},
      {"work-footing", "Strip footing: error of the limit load", "error of the load", plan_footing,
       [](int cells) { return 1.0 / cells; },
       [](int cells, const Discretisation& how) { return run_footing_scene(cells, how); }},
      {"work-pile", "Pile to the experiment: RMS error of its surface (Bui et al. 2008)",
       "RMS error / height", plan_pile, [](int cells) { return pile_height / cells; }, run_pile,
       ConvergedScene{
           "work-pile-converged",
           "Pile to its finest cells: RMS error of its surface to that of the same method",
           "RMS error / height", "", to_finest}},
      {"work-slope", "", "", plan_slope, [](int cells) { return slope_length / cells; }, run_slope,
       ConvergedScene{
           "work-slope",
           "Slope: error of the peak kinetic energy (Wu et al. 2017) to the converged solution",
           "error of the energy", "peak kinetic energy (kJ)", to_extrapolated}},
  };
  return all;
}

} // namespace scarp::bench
