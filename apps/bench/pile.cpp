#include "apps/bench/pile.hpp"

#include "apps/bench/prepared.hpp"

#include "apps/data_directory.hpp"
#include "core/run.hpp"
#include "io/run_recorder.hpp"
#include "io/scene_file.hpp"
#include "render/body.hpp"

namespace scarp::bench {

PileRun collapse_pile(int cells, const Discretisation& how) {
  const std::filesystem::path data = apps::data_directory();
  Scene scene = io::read_scene(data / "scenes/bui2008.toml");
  discretise(scene, pile_height / cells, how);
  scene.output.fields = {"initial_volume"};
  const io::Table experiment = io::read_table(data / "reference/bui2008_surface.csv");

  const auto simulation = make_simulation(scene);
  Observer nobody;
  run(*simulation, scene.timing, nobody);

  const render::BodyShape body = render::measure_body(io::frame_of(*simulation, scene));
  PileRun pile = {
      {}, render::surface_error(body, experiment).rms, simulation->points(), simulation->steps()};
  for (const double x : experiment.column("x_m"))
    pile.surface.push_back(body.height_at(x).value_or(0.0));
  return pile;
}

} // namespace scarp::bench
