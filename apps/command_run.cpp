// scarp run SCENE.toml --out DIR
#include "apps/commands.hpp"
#include "apps/run_scene.hpp"

#include "io/scene_file.hpp"

#include <fmt/format.h>

#include <memory>

namespace scarp::apps {

void add_run(CLI::App& program) {
  struct Options {
    std::filesystem::path scene;
    std::filesystem::path out;
    std::vector<std::string> set;
    int threads = 0;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("run", "Run a scene and write its series.");
  command->add_option("scene", options->scene, "Scene file (TOML); `scarp options` lists its keys")
      ->required();
  command->add_option("--out", options->out, "Directory for the results")->required();
  command->add_option("--set", options->set, "key=value that overrides the scene; repeatable")
      ->allow_extra_args(false);
  command->add_option("--threads", options->threads, "Threads; default: all there are")
      ->check(CLI::Range(1, 1024));
  command->footer("Writes DIR/SCENE.pvd (ParaView), DIR/history.csv and DIR/run.json.\n"
                  "Example:\n  scarp run data/scenes/bui2008.toml --out out/pile "
                  "--set grid.cell_size_m=0.005 --set material.rods.friction_angle_deg=25");
  command->callback([options] {
    const Scene scene = io::read_scene(options->scene, options->set);
    const std::string name = options->scene.stem().string();
    const RunOutcome outcome = run_scene(scene, options->out, name, options->threads);
    fmt::print("{} at {:.4g} s after {} steps, {:.1f} s of wall time; open {}\n",
               outcome.at_rest ? "at rest" : "end time", outcome.stop_time, outcome.steps,
               outcome.wall, (options->out / (name + ".pvd")).string());
  });
}

} // namespace scarp::apps
