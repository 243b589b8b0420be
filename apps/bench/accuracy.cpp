#include "apps/bench/accuracy.hpp"

#include "core/error.hpp"
#include "io/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace scarp::bench {

namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool wanted(const AccuracyOptions& options, const std::string& name) {
  return options.only.empty() || std::ranges::find(options.only, name) != options.only.end();
}

CaseResult run_case(const Case& one, Effort effort) {
  CaseResult result;
  result.origin = &one;
  const Stopwatch watch;
  try {
    result.report = one.run(effort);
  } catch (const RunError& error) {
    result.failure = error.what();
  }
  result.wall = watch.seconds();
  return result;
}

void print(const CaseResult& result) {
  fmt::print("{} ({:.1f} s)\n", result.origin->name, result.wall);
  for (const Check& check : result.report.checks)
    fmt::print("  {} {:34} {:>12.6g} {:4} demanded {}\n", check.pass() ? "ok    " : "FAILED",
               check.name, check.value, check.unit, check.demand());
  if (!result.failure.empty()) fmt::print("  FAILED {}\n", result.failure);
  std::fflush(stdout);
}

void print(const WorkResult& result) {
  fmt::print("{}\n", result.name());
  for (const auto& [method, converged] : result.verdicts)
    fmt::print("  {:34} {:28} {}\n", method, answers_of(result, method), converged.verdict);
  std::fflush(stdout);
}

/// Its answer where the error is known only when all have run.
void print(const WorkRun& run) {
  const WorkOutcome& outcome = run.outcome;
  const std::string result = std::isnan(outcome.error)
                                 ? fmt::format("answer {:<9.4g}", outcome.answer.front())
                                 : fmt::format("error {:<10.3e}", outcome.error);
  fmt::print("  {:34} h = {:<9.4g} {} {:8.2f} s {:10.3g} point-steps {}\n", run.method,
             run.cell_size, result, run.wall, run.point_steps(), run.failure);
  std::fflush(stdout);
}

nlohmann::ordered_json verification_json(const std::vector<CaseResult>& cases) {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const CaseResult& result : cases) {
    for (const Check& check : result.report.checks)
      all[result.origin->name + "." + check.name] = to_json(check);
    if (!result.failure.empty())
      all[result.origin->name + ".run"] = {{"pass", false}, {"note", result.failure}};
  }
  return all;
}

void write_json(const AccuracyOptions& options, const std::vector<CaseResult>& cases,
                const std::vector<WorkResult>& work, double wall) {
  nlohmann::ordered_json record = {{"quick", options.quick},
                                   {"wall_s", wall},
                                   {"verification", verification_json(cases)},
                                   {"convergence", nlohmann::ordered_json::object()},
                                   {"case_wall_s", nlohmann::ordered_json::object()},
                                   {"work_precision", nlohmann::ordered_json::array()}};
  for (const CaseResult& result : cases) {
    record["case_wall_s"][result.origin->name] = result.wall;
    for (const Convergence& one : result.report.convergence)
      record["convergence"][result.origin->name].push_back(to_json(one));
  }
  for (const WorkResult& result : work)
    for (const WorkRun& run : result.runs) record["work_precision"].push_back(to_json(run));
  io::write_atomically(options.out / "accuracy.json", record.dump(2) + "\n");
}

} // namespace

bool CaseResult::passes() const {
  return failure.empty() && std::ranges::all_of(report.checks, &Check::pass);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Case& one : cases()) all.push_back(one.name);
  for (const WorkScene& scene : work_scenes()) all.push_back(scene.name);
  return all;
}

bool run_accuracy(const AccuracyOptions& options) {
  const Stopwatch watch;
  const Effort effort = options.quick ? Effort::quick : Effort::full;
  std::vector<CaseResult> results;
  for (const Case& one : cases()) {
    if (!wanted(options, one.name)) continue;
    results.push_back(run_case(one, effort));
    print(results.back());
  }
  std::vector<WorkResult> work;
  for (const WorkScene& scene : work_scenes()) {
    if (!wanted(options, scene.name)) continue;
    fmt::print("{}\n", scene.name);
    const WorkResult result = run_work(scene, effort, [](const WorkRun& run) { print(run); });
    if (!scene.error.empty()) work.push_back(result);
    if (!scene.converged) continue;
    work.push_back(converged_work(result));
    print(work.back());
  }
  write_json(options, results, work, watch.seconds());
  write_page(options, results, work, watch.seconds());

  std::size_t checks = 0, failed = 0;
  for (const CaseResult& result : results) {
    checks += result.report.checks.size();
    failed += static_cast<std::size_t>(
        std::ranges::count_if(result.report.checks, [](const Check& c) { return !c.pass(); }));
    if (!result.failure.empty()) ++checks, ++failed;
  }
  fmt::print("{} of {} checks passed ({:.0f} s); {}\n", checks - failed, checks, watch.seconds(),
             (options.out / "index.html").string());
  return failed == 0;
}

} // namespace scarp::bench
