// Stress scenes run in memory, with their checks.
#pragma once

#include "apps/stress_checks.hpp"
#include "apps/stress_scenes.hpp"

#include <functional>
#include <optional>

namespace scarp::apps {

enum class StressEnd { finished, left_grid, refused, failed };

struct StressResult {
  std::size_t number = 0;
  std::string family;
  StressEnd end = StressEnd::finished;
  std::string message;                  ///< of the solver, if it refused or stopped
  std::optional<StressFailure> failure; ///< of a failed one
  std::size_t points = 0;
  long steps = 0;
  std::map<std::string, double> nearest; ///< StressChecks::nearest()
};

/// Runs a scene until its end or its first failure.  Never throws for what the solver says.
StressResult run_stress_scene(const StressScene& stress);

/// Scenes 0 .. count - 1 of a seed, `jobs` side by side on one thread each; in their order.
/// Calls done(result) after each, from one thread at a time.
std::vector<StressResult> run_stress_scenes(Preset preset, std::uint64_t seed, std::size_t count,
                                            int jobs,
                                            const std::function<void(const StressResult&)>& done);

} // namespace scarp::apps
