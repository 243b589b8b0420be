#include "core/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

/// Multiples of an interval, one after the other, from a start on.
class Multiples {
 public:
  Multiples(double interval, double start)
      : interval_(interval), next_(std::floor(start / interval * (1.0 + 1e-12)) + 1.0) {}

  double next() const { return next_ * interval_; }

  /// Whether the time has come to the next one; goes on to the first one after `time` if so.
  bool reached(double time) {
    const bool due = time >= next();
    while (time >= next()) ++next_;
    return due;
  }

 private:
  double interval_;
  double next_;
};

} // namespace

double history_interval(const Timing& timing) {
  return timing.history_interval > 0.0 ? timing.history_interval : 0.1 * timing.output_interval;
}

RunSummary run(Simulation& simulation, const Timing& timing, Observer& observer) {
  RunSummary summary;
  summary.shortest_step = std::numeric_limits<double>::infinity();
  std::optional<RestWatch> rest;
  bool at_rest = false;

  const auto record_history = [&] {
    const Energies energies = simulation.energies();
    summary.peak_kinetic = std::max(summary.peak_kinetic, energies.kinetic);
    observer.history(simulation, energies);
    at_rest = rest && !simulation.waits_for_gate() &&
              rest->at_rest(simulation.time(), energies.grid_kinetic);
  };
  const auto step = [&](double until) {
    const double stable = simulation.stable_time_step();
    const double dt = simulation.step(until);
    if (dt == stable) summary.shortest_step = std::min(summary.shortest_step, dt);
    summary.longest_step = std::max(summary.longest_step, dt);
    observer.progress(simulation);
  };

  Multiples frames(timing.output_interval, simulation.time());
  Multiples rows(history_interval(timing), simulation.time());
  observer.frame(simulation);
  double last_frame = simulation.time();
  for (bool first = true;; first = false) {
    if (simulation.stage().until_rest) rest.emplace(timing);
    if (first) record_history();
    while (simulation.time() < simulation.stage_end() && !at_rest) {
      const double due = std::min(frames.next(), simulation.stage_end());
      while (simulation.time() < due && !at_rest) {
        try {
          step(due);
        } catch (const RunError&) {
          if (simulation.time() > last_frame) observer.frame(simulation);
          throw;
        }
        if (rows.reached(simulation.time())) record_history();
      }
      frames.reached(simulation.time());
      observer.frame(simulation);
      last_frame = simulation.time();
    }
    if (simulation.in_last_stage()) break;
    simulation.next_stage();
    rest.reset();
    at_rest = false;
  }
  if (summary.shortest_step > summary.longest_step) summary.shortest_step = summary.longest_step;
  summary.reason = at_rest ? StopReason::at_rest : StopReason::end_time;
  summary.stop_time = simulation.time();
  return summary;
}

} // namespace scarp
