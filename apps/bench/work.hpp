// Work-precision: the error of a scene over what it costs, for many ways to compute it; the error
// to a known answer, to the solution that the runs themselves converge to, or both.  One more scene
// is one line in work_scenes.cpp.
#pragma once

#include "apps/bench/bar.hpp"
#include "apps/bench/cases.hpp"
#include "apps/bench/converged.hpp"

#include <functional>
#include <optional>

namespace scarp::bench {

/// A way to compute, and the cells across the scene's length to do so with, coarse to fine.
struct WorkPlan {
  std::string method;
  Discretisation how;
  std::vector<int> levels;
};

/// What one run says of itself.
struct WorkOutcome {
  double error = 0.0; ///< -, relative to a known answer
  std::size_t points = 0;
  long steps = 0;
  std::vector<double> answer = {}; ///< by which runs with other cells are compared
};

/// Errors to the converged solution, beside or instead of those to a known answer.
struct ConvergedScene {
  std::string name;   ///< in accuracy.json
  std::string title;  ///< for the figure
  std::string error;  ///< for the axis
  std::string answer; ///< its first number, for the axis of a panel; empty: no such panel
  Converged (*judge)(const std::vector<double>& cell_size, const Answers& answer);
};

struct WorkScene {
  std::string name;  ///< for --only
  std::string title; ///< for the figure
  std::string error; ///< what the error is, for the axis; empty: there is no known answer
  std::vector<WorkPlan> (*plan)(Effort effort);
  double (*cell_size)(int cells); ///< m
  WorkOutcome (*run)(int cells, const Discretisation& how);
  std::optional<ConvergedScene> converged = {};
};

struct WorkRun {
  std::string scene;
  std::string method; ///< its name, the same for all cell sizes
  Discretisation how;
  double cell_size = 0.0; ///< m
  WorkOutcome outcome;
  std::string failure;                          ///< what the solver said, if it stopped
  double wall = 0.0;                            ///< s
  std::optional<ConvergedError> converged = {}; ///< then outcome.error is this one's

  double point_steps() const {
    return static_cast<double>(outcome.points) * static_cast<double>(outcome.steps);
  }
};

struct MethodVerdict {
  std::string method;
  Converged converged;
};

struct WorkResult {
  const WorkScene* origin = nullptr;
  std::vector<WorkRun> runs;
  std::vector<MethodVerdict> verdicts = {}; ///< of errors to the converged solution

  bool to_converged() const { return !verdicts.empty(); }
  const std::string& name() const;
  const std::string& title() const;
  const std::string& error() const;
};

const std::vector<WorkScene>& work_scenes();

/// Shape functions, transfer and rate of volume with their usual points and CFL, then one change of
/// these at a time for two of them.
std::vector<WorkPlan> every_method(Effort effort, const std::vector<int>& levels);

/// The few that matter for large motion.  `finest`, if any, is one more level for the two presets.
std::vector<WorkPlan> landslide_methods(Effort effort, const std::vector<int>& levels,
                                        std::optional<int> finest = {});

/// The whole plan of a scene.  `done` is called after each run.
WorkResult run_work(const WorkScene& scene, Effort effort,
                    const std::function<void(const WorkRun&)>& done);

/// The same runs with their errors to the converged solution, for a scene that asks for these.
WorkResult converged_work(const WorkResult& result);

/// First numbers of a method's answers, coarse to fine; empty if the scene has no name for these.
std::string answers_of(const WorkResult& result, const std::string& method);

/// Error over wall time and over point-steps, a line a method; the Pareto front is marked, and how
/// far errors are uncertain.
std::vector<render::Chart> work_figure(const WorkResult& result);

/// The answer over the cell size, and what it is extrapolated to; empty if the scene has none.
std::vector<render::Chart> answer_figure(const WorkResult& result);

nlohmann::ordered_json to_json(const WorkRun& run);

} // namespace scarp::bench
