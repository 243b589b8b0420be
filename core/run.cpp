#include "core/run.hpp"

#include <algorithm>
#include <limits>

namespace scarp {

namespace {

/// Whether the grid's kinetic energy has stayed low for long enough.
class RestWatch {
 public:
  explicit RestWatch(const Timing& timing) : timing_(&timing) {}

  bool at_rest(double time, double kinetic) {
    if (timing_->rest_energy_fraction <= 0.0) return false;
    peak_ = std::max(peak_, kinetic);
    if (peak_ == 0.0 || kinetic > timing_->rest_energy_fraction * peak_)
      low_since_ = never;
    else
      low_since_ = std::min(low_since_, time);
    return time - low_since_ >= timing_->rest_duration;
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  const Timing* timing_;
  double peak_ = 0.0;
  double low_since_ = never;
};

} // namespace

RunSummary run(Simulation& simulation, const Timing& timing, Observer& observer) {
  const double history_interval =
      timing.history_interval > 0.0 ? timing.history_interval : 0.1 * timing.output_interval;
  RunSummary summary;
  summary.shortest_step = std::numeric_limits<double>::infinity();
  RestWatch rest(timing);

  const auto record_history = [&] {
    const Energies energies = simulation.energies();
    summary.peak_kinetic = std::max(summary.peak_kinetic, energies.kinetic);
    observer.history(simulation, energies);
    return !simulation.waits_for_gate() && rest.at_rest(simulation.time(), energies.grid_kinetic);
  };

  observer.frame(simulation);
  double last_frame = simulation.time();
  record_history();
  long frame = 0;
  long row = 1;
  bool at_rest = false;
  while (simulation.time() < timing.end_time && !at_rest) {
    ++frame;
    const double due =
        std::min(static_cast<double>(frame) * timing.output_interval, timing.end_time);
    while (simulation.time() < due && !at_rest) {
      const double stable = simulation.stable_time_step();
      double dt = 0.0;
      try {
        dt = simulation.step(due);
      } catch (const RunError&) {
        if (simulation.time() > last_frame) observer.frame(simulation);
        throw;
      }
      if (dt == stable) summary.shortest_step = std::min(summary.shortest_step, dt);
      summary.longest_step = std::max(summary.longest_step, dt);
      observer.progress(simulation);
      if (simulation.time() >= static_cast<double>(row) * history_interval) {
        at_rest = record_history();
        while (simulation.time() >= static_cast<double>(row) * history_interval) ++row;
      }
    }
    observer.frame(simulation);
    last_frame = simulation.time();
  }
  if (summary.shortest_step > summary.longest_step) summary.shortest_step = summary.longest_step;
  summary.reason = at_rest ? StopReason::at_rest : StopReason::end_time;
  summary.stop_time = simulation.time();
  return summary;
}

} // namespace scarp
