// Work-precision: the error of a scene with a known answer over what it costs, for many ways to
// compute it.  One more scene is one line in work_scenes.cpp.
#pragma once

#include "apps/bench/bar.hpp"
#include "apps/bench/cases.hpp"

#include <functional>

namespace scarp::bench {

/// What one run says of itself.
struct WorkOutcome {
  double error = 0.0; ///< -, relative
  std::size_t points = 0;
  long steps = 0;
};

struct WorkScene {
  std::string name;  ///< for --only
  std::string title; ///< for the figure
  std::string error; ///< what the error is, for the axis
  /// Cells across the scene's length, coarse to fine.
  std::vector<int> (*levels)(Effort effort);
  double (*cell_size)(int cells); ///< m
  WorkOutcome (*run)(int cells, const Discretisation& how);
};

struct WorkRun {
  std::string scene;
  std::string method; ///< its name, the same for all cell sizes
  Discretisation how;
  double cell_size = 0.0; ///< m
  WorkOutcome outcome;
  std::string failure; ///< what the solver said, if it stopped
  double wall = 0.0;   ///< s

  double point_steps() const {
    return static_cast<double>(outcome.points) * static_cast<double>(outcome.steps);
  }
};

struct WorkResult {
  const WorkScene* origin = nullptr;
  std::vector<WorkRun> runs;
};

const std::vector<WorkScene>& work_scenes();

/// Every method at every level.  `done` is called after each run.
WorkResult run_work(const WorkScene& scene, Effort effort,
                    const std::function<void(const WorkRun&)>& done);

/// Error over wall time and over point-steps, a line a method; the Pareto front is marked.
std::vector<render::Chart> work_figure(const WorkResult& result);

nlohmann::ordered_json to_json(const WorkRun& run);

} // namespace scarp::bench
