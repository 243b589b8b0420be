#include "apps/bench/prepared.hpp"

#include <cmath>
#include <utility>

namespace scarp::bench {

Region box(const std::string& name, const std::string& material, std::array<double, 2> lower,
           std::array<double, 2> upper) {
  Region region;
  region.name = name;
  region.material = material;
  region.polygon = {
      {lower[0], lower[1]}, {upper[0], lower[1]}, {upper[0], upper[1]}, {lower[0], upper[1]}};
  return region;
}

Grid plane_grid(double cell_size, std::array<double, 2> lower, std::array<double, 2> upper) {
  Grid grid;
  grid.dimension = 2;
  grid.cell_size = cell_size;
  grid.lower = {lower[0], 0.0, lower[1]};
  grid.upper = {upper[0], 0.0, upper[1]};
  return grid;
}

Material grains() {
  DruckerPrager law;
  law.friction_angle = 30.0;
  law.cone = Cone::plane_strain;
  law.opening = Opening::remembered;
  return {"grains", 2650.0, 1e6, 0.3, law};
}

void discretise(Scene& scene, double cell_size, const Discretisation& how) {
  Grid& grid = scene.grid;
  grid.cell_size = cell_size;
  grid.points_per_cell = how.points_per_cell;
  for (const std::size_t axis : {0U, 2U})
    grid.upper[axis] =
        grid.lower[axis] +
        cell_size * std::ceil((grid.upper[axis] - grid.lower[axis]) / cell_size - 1e-9);
  scene.timing.cfl = how.cfl;
  scene.method.shape = how.method.shape;
  scene.method.transfer = how.method.transfer;
  scene.method.volume_rate = how.method.volume_rate;
  scene.method.precision = how.method.precision;
}

Snapshot at_rest(const Simulation& simulation) {
  const std::size_t n = simulation.points();
  Snapshot start;
  start.position = simulation.positions();
  start.displacement.assign(3 * n, 0.0);
  start.velocity = simulation.field("velocity");
  start.stress.assign(6 * n, 0.0);
  start.volume = simulation.field("volume");
  start.initial_volume = simulation.field("initial_volume");
  start.plastic_strain.assign(n, 0.0);
  start.gap.assign(n, 0.0);
  start.velocity_gradient.assign(9 * n, 0.0);
  return start;
}

std::unique_ptr<Simulation> begin_from(Scene scene, const Snapshot& start) {
  constexpr double for_ever = 1e9; // s
  Stage stage;
  stage.name = "run";
  stage.duration = for_ever;
  stage.begin_from = "a state made by hand";
  scene.stages = {stage};
  return make_simulation(scene, &start);
}

std::unique_ptr<Simulation> begin_with(Scene scene, const std::function<void(Snapshot&)>& change) {
  Snapshot start = at_rest(*make_simulation(scene));
  change(start);
  return begin_from(std::move(scene), start);
}

std::vector<double> masses(const Simulation& simulation) {
  std::vector<double> mass = simulation.field("density");
  const std::vector<double> volume = simulation.field("volume");
  for (std::size_t p = 0; p < mass.size(); ++p) mass[p] *= volume[p];
  return mass;
}

void run_until(Simulation& simulation, double time) {
  while (simulation.time() < time) simulation.step(time);
}

} // namespace scarp::bench
