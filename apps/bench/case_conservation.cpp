// What the scheme must keep, whatever the material: mass, momentum, and no energy from nothing.
#include "apps/bench/cases.hpp"
#include "apps/bench/prepared.hpp"

#include <algorithm>
#include <cmath>

namespace scarp::bench {

namespace {

struct Totals {
  double mass = 0.0;                           ///< kg
  std::array<double, 2> momentum = {0.0, 0.0}; ///< kg m/s, x z
  double size = 0.0;                           ///< kg m/s, sum m |v|
};

Totals totals(const Simulation& simulation) {
  const std::vector<double> m = masses(simulation);
  const std::vector<double> v = simulation.field("velocity");
  Totals sum;
  for (std::size_t p = 0; p < m.size(); ++p) {
    sum.mass += m[p];
    sum.momentum[0] += m[p] * v[3 * p];
    sum.momentum[1] += m[p] * v[3 * p + 2];
    sum.size += m[p] * std::hypot(v[3 * p], v[3 * p + 2]);
  }
  return sum;
}

struct Collision {
  double mass_error = 0.0;     ///< -, of the bodies' areas times density
  double momentum_error = 0.0; ///< -, largest, parts of sum m |v|
};

/// Two free bodies, one elastic, one of weak soil, that meet at an angle.
Collision collide() {
  Scene scene;
  scene.grid = plane_grid(0.1, {-2.0, -2.0}, {3.0, 3.0});
  DruckerPrager soil;
  soil.cohesion = 2e3;
  soil.friction_angle = 20.0;
  scene.materials = {{"elastic", 1000.0, 1e6, 0.3, LinearElastic{}},
                     {"soil", 1800.0, 2e6, 0.2, soil}};
  scene.gravity = {0.0, 0.0, 0.0};
  scene.regions = {box("one", "elastic", {-1.0, 0.0}, {0.0, 0.65}),
                   box("other", "soil", {0.15, 0.2}, {1.2, 1.0})};
  scene.regions[0].velocity = {3.0, 0.0, 0.5};
  scene.regions[1].velocity = {-1.0, 0.0, -0.3};
  const auto simulation = make_simulation(scene);
  const Totals start = totals(*simulation);
  const double mass = 1000.0 * 0.65 + 1800.0 * 1.05 * 0.8;
  Collision result;
  for (int sample = 1; sample <= 20; ++sample) {
    run_until(*simulation, 0.015 * sample);
    const Totals now = totals(*simulation);
    result.mass_error = std::max(result.mass_error, std::abs(now.mass / mass - 1.0));
    for (std::size_t i = 0; i < 2; ++i)
      result.momentum_error = std::max(result.momentum_error,
                                       std::abs(now.momentum[i] - start.momentum[i]) / start.size);
  }
  return result;
}

struct Collapse {
  std::vector<double> time; ///< s
  /// J/m
  std::vector<double> gravity_work, kinetic, strain, plastic, loss;
};

Collapse collapse() {
  Scene scene;
  scene.grid = plane_grid(0.01, {0.0, 0.0}, {0.8, 0.15});
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  DruckerPrager law;
  law.friction_angle = 25.0;
  law.opening = Opening::remembered;
  scene.materials = {{"grains", 2000.0, 1e6, 0.3, law}};
  scene.method.shape = ShapeFunctions::bspline;
  scene.regions = {box("pile", "grains", {0.0, 0.0}, {0.2, 0.1})};
  const auto simulation = make_simulation(scene);
  Collapse result;
  for (int sample = 1; sample <= 100; ++sample) {
    run_until(*simulation, 0.01 * sample);
    const Energies e = simulation->energies();
    result.time.push_back(simulation->time());
    result.gravity_work.push_back(e.gravity_work);
    result.kinetic.push_back(e.kinetic);
    result.strain.push_back(e.strain);
    result.plastic.push_back(e.plastic);
    result.loss.push_back(e.scheme_loss);
  }
  return result;
}

/// The least step from one value to the next.
double least_rise(const std::vector<double>& values) {
  double least = values.front();
  for (std::size_t i = 1; i < values.size(); ++i)
    least = std::min(least, values[i] - values[i - 1]);
  return least;
}

} // namespace

CaseReport conservation_case(Effort) {
  const Collision collision = collide();
  const Collapse pile = collapse();
  const double work = pile.gravity_work.back();
  CaseReport report;
  const std::string scene = "an elastic body meets one of soil in free flight";
  report.checks = {
      {"mass", collision.mass_error, 0.0, 1e-12, Bound::at_most, "-", "density times area", scene},
      {"momentum", collision.momentum_error, 0.0, 1e-12, Bound::at_most, "-",
       "no force from outside; parts of sum m |v|", scene},
      {"plastic_work_rises", least_rise(pile.plastic) / work, 0.0, 0.0, Bound::at_least, "-",
       "second law: plastic work never falls", "least rise in 0.01 s, parts of gravity's work"},
      // Velocities stand half a step before the stress, so the sum of both energies swings a
      // little.
      {"energy_made_by_the_scheme", *std::ranges::min_element(pile.loss) / work, 0.0, -2e-3,
       Bound::at_least, "-", "the scheme may lose energy, never make any",
       "least loss of the scheme so far, parts of gravity's work; B-splines, FLIP = 1"},
      {"energy_lost_by_the_scheme", pile.loss.back() / work, 0.0, 0.05, Bound::at_most, "-",
       "the bound on the pile of Bui et al. 2008 (README.md)", "at the end"}};
  const auto curve = [&](const char* name, const std::vector<double>& values) {
    return render::Curve{.label = name, .x = pile.time, .y = values};
  };
  report.figure = {{{curve("work of gravity", pile.gravity_work), curve("plastic", pile.plastic),
                     curve("kinetic", pile.kinetic), curve("elastic", pile.strain),
                     curve("lost by the scheme", pile.loss)},
                    {.x_name = "time", .x_unit = "s", .y_name = "energy", .y_unit = "J/m"}}};
  report.caption = "Energies of a collapsing pile, FLIP = 1.";
  return report;
}

} // namespace scarp::bench
