// One line that tells how far a run is.
#pragma once

#include "core/simulation.hpp"

#include <chrono>

namespace scarp::apps {

/// Writes to stderr, and only if that is a terminal.
class ProgressLine {
 public:
  ProgressLine(double start_time, double end_time);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  void update(const Simulation& simulation);

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  bool written_ = false;
  double start_time_; ///< s
  double end_time_;   ///< s
  long steps_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
};

} // namespace scarp::apps
