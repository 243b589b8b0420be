#include "apps/bench/footing.hpp"

#include "apps/bench/prepared.hpp"

#include <cmath>

namespace scarp::bench {

namespace {

constexpr double width = 1.0;           // m, B
constexpr double cohesion = 1000.0;     // Pa
constexpr double modulus = 4e6;         // Pa: E/c = 4000, see footing.hpp
constexpr double poissons_ratio = 0.3;  // -
constexpr double density = 1000.0;      // kg/m3
constexpr double settlement = 0.005;    // m, in the end
constexpr double footing_height = 0.25; // m
constexpr int samples = 100;

/// Wave speed of the soil, m/s.
double wave_speed() {
  return std::sqrt(modulus * (1.0 - poissons_ratio) /
                   ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio)) / density);
}

/// Inertia, rho c v, is then 2.5e-5 of the P-wave modulus, 0.13 c, of which little reaches the
/// load.
double speed() { return 0.25e-4 * wave_speed(); }

Scene footing(int cells, const Discretisation& how) {
  const double h = width / cells;
  const auto planes = [h](double x) { return std::ceil(x / h - 1e-9) * h; };
  const double side = planes(2.25 * width);
  const double depth = planes(1.25 * width);
  Scene scene;
  scene.grid = plane_grid(h, {0.0, -depth}, {side, planes(footing_height) + 2.0 * h});
  scene.grid.points_per_cell = how.points_per_cell;
  scene.grid.walls[0][0].kind = scene.grid.walls[0][1].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  DruckerPrager law;
  law.cohesion = cohesion;
  law.cone = Cone::plane_strain;
  // Over the whole run the footing loses about a thousandth of its velocity.
  const double impulse = prandtl * cohesion * 0.5 * width * settlement / speed();
  const double heavy = 1e3 * impulse / speed() / (0.5 * width * planes(footing_height));
  scene.materials = {{"soil", density, modulus, poissons_ratio, law},
                     {"footing", heavy, modulus * heavy / density, 0.0, LinearElastic{}}};
  scene.gravity = {0.0, 0.0, 0.0};
  scene.method = how.method;
  scene.timing.cfl = how.cfl;
  scene.regions = {box("soil", "soil", {0.0, -depth}, {side, 0.0}),
                   box("footing", "footing", {0.0, 0.0}, {0.5 * width, planes(footing_height)})};
  scene.regions[1].velocity = {0.0, 0.0, -speed()};
  return scene;
}

double mean_between(const std::vector<double>& values, double from, double to) {
  const auto n = static_cast<double>(values.size());
  const auto first = static_cast<std::size_t>(from * n);
  const auto last = static_cast<std::size_t>(to * n);
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) sum += values[i];
  return sum / static_cast<double>(last - first);
}

} // namespace

double FootingRun::limit() const { return mean_between(pressure, 0.8, 1.0); }

double FootingRun::growth() const { return 1.0 - mean_between(pressure, 0.6, 0.8) / limit(); }

FootingRun press_footing(int cells, const Discretisation& how) {
  const auto simulation = make_simulation(footing(cells, how));
  const std::vector<double> mass = masses(*simulation);
  const std::vector<double> region = simulation->field("region");
  const auto momentum = [&] {
    const std::vector<double> v = simulation->field("velocity");
    double sum = 0.0;
    for (std::size_t p = 0; p < mass.size(); ++p)
      if (region[p] == 1.0) sum += mass[p] * v[3 * p + 2];
    return sum;
  };
  FootingRun run;
  run.points = mass.size();
  double before = momentum();
  double time = 0.0;
  for (int sample = 1; sample <= samples; ++sample) {
    run_until(*simulation, settlement / speed() * sample / samples);
    const double now = momentum();
    run.settlement.push_back(speed() * 0.5 * (simulation->time() + time) / width);
    run.pressure.push_back((now - before) / (simulation->time() - time) / (0.5 * width * cohesion));
    before = now;
    time = simulation->time();
  }
  run.steps = simulation->steps();
  return run;
}

} // namespace scarp::bench
