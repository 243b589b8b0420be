#include "apps/bench/bar.hpp"

#include "apps/bench/prepared.hpp"

#include <cmath>
#include <numbers>

namespace scarp::bench {

namespace {

constexpr double length = 1.0;               // m
constexpr double density = 1000.0;           // kg/m3
constexpr double modulus = 1e5;              // Pa: c = 10 m/s
constexpr double amplitude = 1e-4;           // m/s: strains of 1e-5, no point leaves its cell
constexpr double frequency = 10.0 / 4.0;     // 1/s, exact
constexpr double k = 0.5 * std::numbers::pi; // 1/m

Scene bar(int cells, const Discretisation& how) {
  const double h = length / cells;
  Scene scene;
  scene.grid = plane_grid(h, {0.0, 0.0}, {length + 2.0 * h, h});
  scene.grid.points_per_cell = how.points_per_cell;
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = scene.grid.walls[2][1].kind = WallKind::symmetry;
  scene.materials = {{"bar", density, modulus, 0.0, LinearElastic{}}};
  scene.gravity = {0.0, 0.0, 0.0};
  scene.method = how.method;
  scene.timing.cfl = how.cfl;
  scene.regions = {box("bar", "bar", {0.0, 0.0}, {length, h})};
  return scene;
}

} // namespace

Vibration vibrate_bar(int cells, int periods, const Discretisation& how) {
  std::vector<double> mode;
  const auto simulation = begin_with(bar(cells, how), [&](Snapshot& start) {
    for (std::size_t p = 0; p < start.gap.size(); ++p) {
      mode.push_back(std::sin(k * start.position[3 * p]));
      start.velocity[3 * p] = amplitude * mode[p];
    }
  });
  const auto velocity = [&] { // along the mode
    const std::vector<double> v = simulation->field("velocity");
    double sum = 0.0;
    for (std::size_t p = 0; p < mode.size(); ++p) sum += mode[p] * v[3 * p];
    return sum;
  };

  double v_before = velocity();
  double first_zero = 0.0, last_zero = 0.0;
  double energy = 0.0, duration = 0.0, first_energy = 0.0; // of the period in hand
  int zeros = 0;
  const double give_up = 2.0 * (periods + 1) / frequency; // a damped bar may stop swinging
  while (zeros <= periods && simulation->time() < give_up) {
    const double dt = simulation->step(give_up);
    const Energies e = simulation->energies();
    energy += dt * (e.kinetic + e.strain);
    duration += dt;
    const double v = velocity();
    if (v_before > 0.0 && v <= 0.0) {
      last_zero = simulation->time() - dt * v / (v - v_before);
      if (zeros == 0) first_zero = last_zero;
      if (zeros == 1) first_energy = energy / duration;
      if (zeros < periods) energy = duration = 0.0;
      ++zeros;
    }
    v_before = v;
  }
  if (zeros <= periods) return {1.0, -1.0, mode.size(), simulation->steps()};
  return {periods / (last_zero - first_zero) / frequency - 1.0,
          energy / duration / first_energy - 1.0, mode.size(), simulation->steps()};
}

} // namespace scarp::bench
