#include "apps/run_scene.hpp"

#include "apps/progress.hpp"
#include "apps/usage.hpp"
#include "io/run_recorder.hpp"
#include "io/snapshot.hpp"

#include <omp.h>

#include <cstdio>

namespace scarp::apps {

namespace {

class ProgressRecorder final : public io::RunRecorder {
 public:
  ProgressRecorder(const Scene& scene, const Simulation& simulation,
                   const std::filesystem::path& directory, const std::string& name, int threads)
      : RunRecorder(scene, simulation, directory, name, threads),
        line_(simulation.time(), end_time(scene)) {}

  void progress(const Simulation& simulation) override {
    RunRecorder::progress(simulation);
    line_.update(simulation);
  }

 private:
  ProgressLine line_;
};

void print_plan(const Scene& scene, const Simulation& simulation, const io::RunRecorder& recorder,
                int threads) {
  std::printf("%s\n", scene.title.empty() ? "untitled scene" : scene.title.c_str());
  std::printf("  %-15s %zu points in %zu of %zu cells, first step %.3g s, %d thread%s\n", "size",
              simulation.points(), simulation.occupied_cells(), simulation.cells(),
              simulation.stable_time_step(), threads, threads == 1 ? "" : "s");
  std::printf("  %-15s %.1f MiB, %.0f bytes a point\n", "memory",
              static_cast<double>(simulation.memory()) / (1024.0 * 1024.0),
              static_cast<double>(simulation.memory()) / static_cast<double>(simulation.points()));
  for (const std::vector<PlanLine>& lines : {simulation.plan(), recorder.plan()})
    for (const PlanLine& line : lines)
      std::printf("  %-15s %s\n", line.what.c_str(), line.how.c_str());
  std::fflush(stdout);
}

} // namespace

RunOutcome run_scene(const Scene& scene, const std::filesystem::path& directory,
                     const std::string& name, int threads) {
  if (threads > 0) omp_set_num_threads(threads);
  const int used = omp_get_max_threads();
  const std::unique_ptr<Simulation> simulation = io::make_simulation_from_files(scene);
  make_directory(directory);
  ProgressRecorder recorder(scene, *simulation, directory, name, used);
  print_plan(scene, *simulation, recorder, used);

  RunSummary summary;
  try {
    summary = run(*simulation, scene.timing, recorder);
  } catch (const RunError& error) {
    recorder.finish(*simulation, std::nullopt, error.what());
    throw;
  }
  recorder.finish(*simulation, summary, "");
  return {simulation->points(), simulation->steps(), summary.stop_time, recorder.wall_seconds(),
          summary.reason == StopReason::at_rest};
}

} // namespace scarp::apps
