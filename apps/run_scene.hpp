// A scene from its first to its last frame on disk: what `run` and `reproduce` share.
#pragma once

#include "core/scene.hpp"

#include <filesystem>
#include <string>

namespace scarp::apps {

struct RunOutcome {
  std::size_t points = 0;
  long steps = 0;
  double stop_time = 0.0; ///< s
  double wall = 0.0;      ///< s
  bool at_rest = false;
};

/// Runs with `threads` threads (0: all there are), prints the plan, shows progress, and writes
/// DIR/NAME.pvd, DIR/history.csv and DIR/run.json, the last also for a failed run before the error
/// goes on to the caller.
RunOutcome run_scene(const Scene& scene, const std::filesystem::path& directory,
                     const std::string& name, int threads);

} // namespace scarp::apps
