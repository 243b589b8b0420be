// scarp info SCENE.toml, scarp options
#include "apps/commands.hpp"

#include "core/simulation.hpp"
#include "io/scene_file.hpp"
#include "io/snapshot.hpp"
#include "io/study_file.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>

namespace scarp::apps {

namespace {

/// s a step, of a few steps of the scene itself.
double seconds_per_step(Simulation& simulation) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  long steps = 0;
  double wall = 0.0;
  while (steps < 200 && wall < 1.0 && simulation.time() < simulation.stage_end()) {
    simulation.step(simulation.stage_end());
    ++steps;
    wall = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return wall / static_cast<double>(steps);
}

} // namespace

void add_info(CLI::App& program) {
  struct Options {
    std::filesystem::path scene;
    std::vector<std::string> set;
    bool all = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("info", "Check a scene and tell its size and cost.");
  command->add_option("scene", options->scene, "Scene file (TOML)")->required();
  command->add_option("--set", options->set, "key=value that overrides the scene; repeatable")
      ->allow_extra_args(false);
  command->add_flag("--all", options->all, "Print every option with the value used, as TOML");
  command->footer("Example:\n  scarp info data/scenes/bui2008.toml --set grid.cell_size_m=0.001");
  command->callback([options] {
    const Scene scene = io::read_scene(options->scene, options->set);
    if (options->all) {
      fmt::print("{}", io::scene_to_toml(scene));
      return;
    }
    const std::unique_ptr<Simulation> simulation = io::make_simulation_from_files(scene);
    const double dt = simulation->stable_time_step();
    fmt::print("{}\n", scene.title);
    fmt::print("  points          {}\n", simulation->points());
    fmt::print("  cells           {} of {}\n", simulation->occupied_cells(), simulation->cells());
    fmt::print("  first step      {:.3g} s\n", dt);
    const double steps = end_time(scene) / dt;
    const double each = seconds_per_step(*simulation);
    fmt::print("  steps           about {:.0f} to the end time, {:.4g} s\n", steps,
               end_time(scene));
    fmt::print("  run time        about {:.0f} s on this machine\n", steps * each);
    for (const PlanLine& line : simulation->plan())
      fmt::print("  {:<15} {}\n", line.what, line.how);
  });
}

void add_options(CLI::App& program) {
  const auto study = std::make_shared<bool>(false);
  CLI::App* command =
      program.add_subcommand("options", "Print the manual of scene files (Markdown).");
  command->add_flag("--study", *study, "That of study files instead");
  command->callback([study] {
    fmt::print("{}", *study ? io::study_reference_markdown() : io::scene_reference_markdown());
  });
}

} // namespace scarp::apps
