// A whole run: steps, frames and history rows when they are due, and when it ends.
#pragma once

#include "core/simulation.hpp"

namespace scarp {

enum class StopReason { end_time, at_rest };

struct RunSummary {
  StopReason reason = StopReason::end_time;
  double stop_time = 0.0;     ///< s
  double peak_kinetic = 0.0;  ///< J, of the history rows
  double shortest_step = 0.0; ///< s, of the steps not cut short by a frame or a gate
  double longest_step = 0.0;  ///< s
};

/// s between rows of the history: as the timing says, or a tenth of the output interval.
double history_interval(const Timing& timing);

/// What a run reports to; every function does nothing unless overridden.
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  /// At time 0, at every multiple of the output interval, at the end, and with the positions of the
  /// last good step when the run fails.
  virtual void frame(const Simulation&) {}
  /// At time 0 and at the first step at or after every multiple of the history interval; energies
  /// are computed for these rows alone.
  virtual void history(const Simulation&, const Energies&) {}
  /// After every step.
  virtual void progress(const Simulation&) {}
};

/// Steps until the end time, or until the mass is at rest if the scene says so.  Throws RunError,
/// and what the observer throws.
RunSummary run(Simulation& simulation, const Timing& timing, Observer& observer);

} // namespace scarp
