#include "apps/progress.hpp"

#include <cstdio>

#include <unistd.h>

namespace scarp::apps {

ProgressLine::ProgressLine(double start_time, double end_time)
    : visible_(::isatty(STDERR_FILENO) != 0), start_time_(start_time), end_time_(end_time) {}

ProgressLine::~ProgressLine() {
  if (written_) std::fputc('\n', stderr);
}

void ProgressLine::update(const Simulation& simulation) {
  if (!visible_) return;
  ++steps_;
  const Clock::time_point now = Clock::now();
  if (now - shown_ < std::chrono::milliseconds(250)) return;
  shown_ = now;
  written_ = true;
  const double wall = std::chrono::duration<double>(now - start_).count();
  const double part = (simulation.time() - start_time_) / (end_time_ - start_time_);
  const double speed =
      static_cast<double>(simulation.points()) * static_cast<double>(steps_) / wall;
  std::fprintf(stderr, "\r%5.1f %%  %.3f s simulated  %.1f million point-steps/s  %.0f s left   ",
               100.0 * part, simulation.time(), speed / 1e6, wall * (1.0 - part) / part);
  std::fflush(stderr);
}

} // namespace scarp::apps
