#include "apps/bench/slope.hpp"

#include "apps/bench/prepared.hpp"

#include "apps/data_directory.hpp"
#include "core/run.hpp"
#include "io/scene_file.hpp"

namespace scarp::bench {

SlopeRun slide_slope(int cells, const Discretisation& how) {
  constexpr double thickness = 0.5; // m, of the slice
  constexpr double toe = 70.0;      // m
  Scene scene = io::read_scene(apps::data_directory() / "scenes/wu2017.toml");
  discretise(scene, slope_length / cells, how);
  scene.stages.back().until_rest = true;
  scene.timing.rest_energy_fraction = 0.01;
  scene.timing.rest_duration = 0.5;

  const auto simulation = make_simulation(scene);
  Observer nobody;
  const RunSummary summary = run(*simulation, scene.timing, nobody);
  return {thickness * summary.peak_kinetic, simulation->front() - toe, simulation->points(),
          simulation->steps()};
}

} // namespace scarp::bench
