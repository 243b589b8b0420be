// scarp stress --scenes N --seed S --out DIR
#include "apps/commands.hpp"
#include "apps/stress_run.hpp"
#include "apps/study_progress.hpp"

#include "apps/usage.hpp"
#include "io/atomic_file.hpp"
#include "io/scene_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace scarp::apps {

namespace {

struct StressArguments {
  std::size_t scenes = 2000;
  std::uint64_t seed = 1;
  Preset preset = Preset::accurate;
  int jobs = 0;
  std::filesystem::path out;
};

std::size_t count(const std::vector<StressResult>& results, StressEnd end) {
  return static_cast<std::size_t>(std::ranges::count(results, end, &StressResult::end));
}

/// Writes the scene, from the directory of results on DIR/failed/NNNN.toml.
std::string write_scene(const StressArguments& options, std::size_t number) {
  std::string name = fmt::format("failed/{:04}.toml", number);
  make_directory(options.out / "failed");
  io::write_atomically(options.out / name,
                       io::scene_to_toml(stress_scene(options.preset, options.seed, number).scene));
  return name;
}

nlohmann::ordered_json failure_json(const StressArguments& options, const StressResult& result) {
  const StressFailure& failure = *result.failure;
  return {{"scene", result.number},
          {"family", result.family},
          {"check", failure.check},
          {"value", failure.value},
          {"bound", failure.bound},
          {"what", failure.what},
          {"time_s", failure.time},
          {"step", result.steps},
          {"point", failure.point},
          {"points", result.points},
          {"file", write_scene(options, result.number)}};
}

/// The largest over all scenes.
std::map<std::string, double> nearest(const std::vector<StressResult>& results) {
  std::map<std::string, double> most;
  for (const StressResult& result : results)
    for (const auto& [check, part] : result.nearest) {
      double& now = most[check];
      now = std::max(now, part);
    }
  return most;
}

/// Failures by check and family, and how near the scenes that hold have come.
void print_table(const std::vector<StressResult>& results) {
  std::map<std::string, std::map<std::string, std::size_t>> failed;
  for (const StressResult& result : results)
    if (result.failure) ++failed[result.failure->check][result.family];
  fmt::print("{:9}{:>8}  {}\n", "check", "failed", "by family; else the nearest to its bound");
  auto rest = nearest(results);
  for (const auto& [check, families] : failed) {
    std::size_t sum = 0;
    std::string list;
    for (const auto& [family, scenes] : families) {
      sum += scenes;
      list += fmt::format("{}{} {}", list.empty() ? "" : ", ", family, scenes);
    }
    fmt::print("{:9}{:8}  {}\n", check, sum, list);
    rest.erase(check);
  }
  for (const auto& [check, part] : rest) fmt::print("{:9}{:8}  {:.2g} of it\n", check, 0, part);
}

void report(const StressArguments& options, const std::vector<StressResult>& results, double wall) {
  const std::size_t refused = count(results, StressEnd::refused);
  const std::size_t left = count(results, StressEnd::left_grid);
  const std::size_t failed = count(results, StressEnd::failed);
  nlohmann::ordered_json record = {
      {"scenes", results.size()},    {"refused", refused},
      {"left_grid", left},           {"failed", failed},
      {"seed", options.seed},        {"wall_s", wall},
      {"nearest", nearest(results)}, {"failures", nlohmann::ordered_json::array()}};
  for (const StressResult& result : results)
    if (result.failure) record["failures"].push_back(failure_json(options, result));
  io::write_atomically(options.out / "stress.json", record.dump(2) + "\n");
  print_table(results);
  const std::string summary = fmt::format(
      "{} scenes: {} failed, {} refused, {} left the grid at a free side ({:.0f} s); {}",
      results.size(), failed, refused, left, wall, (options.out / "stress.json").string());
  if (failed > 0) throw std::runtime_error(summary);
  fmt::print("{}\n", summary);
}

void run(const StressArguments& options) {
  make_directory(options.out);
  std::filesystem::remove_all(options.out / "failed"); // of an earlier call
  StudyProgress progress;
  StudyState state{.scenarios = options.scenes};
  const int jobs = static_cast<int>(job_count(options.jobs));
  const auto results = run_stress_scenes(
      options.preset, options.seed, options.scenes, jobs, [&](const StressResult& result) {
        ++state.finished;
        if (result.failure) ++state.failed;
        state.part = static_cast<double>(state.finished) / static_cast<double>(options.scenes);
        progress.show(state);
      });
  progress.clear();
  report(options, results, progress.seconds());
}

} // namespace

void add_stress(CLI::App& program) {
  const auto options = std::make_shared<StressArguments>();
  CLI::App* command =
      program.add_subcommand("stress", "Try the solver's stability on seeded random scenes.");
  command->add_option("--out", options->out, "Directory for stress.json and the scenes that failed")
      ->required();
  command->add_option("--scenes", options->scenes, "How many; default 2000")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--seed", options->seed, "What they are drawn from; default 1");
  command
      ->add_option("--preset", options->preset,
                   "Of the method: accurate (default), or fidelity, with MUSL and USF")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Preset>{
          {"accurate", Preset::accurate}, {"fidelity", Preset::fidelity}}))
      ->default_str("accurate");
  add_jobs(*command, options->jobs, "Scenes");
  command->footer("A scene that fails is written as a scene file, for `scarp run`.\n"
                  "Example:\n  scarp stress --scenes 2000 --seed 1 --out out/stress");
  command->callback([options] { run(*options); });
}

} // namespace scarp::apps
