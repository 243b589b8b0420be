#include "apps/bench/work.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace scarp::bench {

namespace {

WorkRun run_one(const WorkScene& scene, int cells, const WorkPlan& plan) {
  WorkRun run = {scene.name, plan.method, plan.how, scene.cell_size(cells), {}, {}, 0.0};
  const auto start = std::chrono::steady_clock::now();
  try {
    run.outcome = scene.run(cells, plan.how);
  } catch (const RunError& error) {
    run.failure = error.what();
  }
  run.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

} // namespace

WorkResult run_work(const WorkScene& scene, Effort effort,
                    const std::function<void(const WorkRun&)>& done) {
  WorkResult result;
  result.origin = &scene;
  for (const WorkPlan& plan : scene.plan(effort))
    for (const int cells : plan.levels) {
      result.runs.push_back(run_one(scene, cells, plan));
      done(result.runs.back());
    }
  return result;
}

WorkResult converged_work(const WorkResult& result) {
  const ConvergedScene& scene = *result.origin->converged;
  WorkResult converged = {result.origin, {}, {}};
  // The runs of a method follow each other.
  for (auto first = result.runs.begin(); first != result.runs.end();) {
    const auto last = std::find_if(first, result.runs.end(),
                                   [&](const WorkRun& run) { return run.method != first->method; });
    std::vector<double> cell_size;
    Answers answers;
    for (auto run = first; run != last; ++run)
      if (run->failure.empty()) {
        cell_size.push_back(run->cell_size);
        answers.push_back(run->outcome.answer);
      }
    converged.verdicts.push_back({first->method, scene.judge(cell_size, answers)});
    auto error = converged.verdicts.back().converged.errors.begin();
    for (; first != last; ++first) {
      WorkRun run = *first;
      run.scene = scene.name;
      if (run.failure.empty()) {
        run.converged = *error++;
        run.outcome.error = run.converged->error;
      }
      converged.runs.push_back(std::move(run));
    }
  }
  return converged;
}

std::string answers_of(const WorkResult& result, const std::string& method) {
  std::vector<double> answers;
  if (!result.origin->converged->answer.empty())
    for (const WorkRun& run : result.runs)
      if (run.method == method && run.failure.empty())
        answers.push_back(run.outcome.answer.front());
  return fmt::format("{:.4g}", fmt::join(answers, ", "));
}

const std::string& WorkResult::name() const {
  return to_converged() ? origin->converged->name : origin->name;
}

const std::string& WorkResult::title() const {
  return to_converged() ? origin->converged->title : origin->title;
}

const std::string& WorkResult::error() const {
  return to_converged() ? origin->converged->error : origin->error;
}

nlohmann::ordered_json to_json(const WorkRun& run) {
  nlohmann::ordered_json record = {
      {"scene", run.scene},           {"method", run.method},
      {"cell_size", run.cell_size},   {"points_per_cell", run.how.points_per_cell},
      {"cfl", run.how.cfl},           {"error", run.outcome.error},
      {"wall_s", run.wall},           {"point_steps", run.point_steps()},
      {"points", run.outcome.points}, {"steps", run.outcome.steps}};
  if (!run.outcome.answer.empty()) record["answer"] = run.outcome.answer;
  if (run.converged) record["error_between"] = {run.converged->lower, run.converged->upper};
  if (!run.failure.empty()) {
    record["error"] = nullptr;
    record["failure"] = run.failure;
  }
  return record;
}

} // namespace scarp::bench
