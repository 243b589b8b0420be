// Rotation: stress turns with the material, simple shear follows the Jaumann law, a free disc keeps
// its angular momentum.
//
// Simple shear v_x = gamma_dot z: the Jaumann law gives tau_xz = G sin(gamma) and
// tau_xx - tau_zz = 2 G (1 - cos(gamma)) (apps/bench/vortex.hpp, with the axes of the shear fixed).
// Second order in the step is demanded: the trapezoidal rule in the turning frame has it.
#include "apps/bench/bar.hpp"
#include "apps/bench/cases.hpp"
#include "apps/bench/charts.hpp"
#include "apps/bench/prepared.hpp"

#include "core/stress_pass.hpp"

#include <cmath>
#include <numbers>

namespace scarp::bench {

namespace {

constexpr double turn = 2.0 * std::numbers::pi; // rad

/// The largest error of a component of the stress over a whole turn about the axis (1, 2, 3), which
/// takes back the stress it began with; parts of its largest component.  Hughes & Winget's
/// rotation is by the angle a if the spin is 2 tan(a/2).
double error_after_a_turn() {
  constexpr int steps = 360;
  const ElasticModuli moduli = ElasticModuli::from(1e8, 0.25);
  const SymTensor<3> start = {3e3, -2e3, 0.5e3, 0.7e3, -0.4e3, 1.1e3};
  SymTensor<3> stress = start;
  const double spin = 2.0 * std::tan(0.5 * turn / steps) / std::sqrt(14.0);
  const Mat<3> gradient = {{{0.0, -3.0 * spin, 2.0 * spin},
                            {3.0 * spin, 0.0, -1.0 * spin},
                            {-2.0 * spin, 1.0 * spin, 0.0}}};
  for (int i = 0; i < steps; ++i) update_stress<3>(stress, gradient, 1.0, moduli, ElasticUpdate{});
  double error = 0.0;
  for (std::size_t i = 0; i < start.size(); ++i)
    error = std::max(error, std::abs(stress[i] - start[i]) / 3e3);
  return error;
}

/// tau_xz / G over gamma up to a whole period of the law.
render::Curve shear(int steps) {
  const ElasticModuli moduli = {1.0, 1.0};
  SymTensor<2> stress = {};
  render::Curve curve;
  const Mat<2> gradient = {{{0.0, turn / steps}, {0.0, 0.0}}};
  for (int i = 1; i <= steps; ++i) {
    update_stress<2>(stress, gradient, 1.0, moduli, ElasticUpdate{});
    curve.x.push_back(turn * i / steps);
    curve.y.push_back(stress[3]);
  }
  return curve;
}

Convergence shear_convergence() {
  Convergence convergence = {"simple shear", {}, {}};
  for (const int steps : {16, 32, 64, 128}) {
    const render::Curve curve = shear(steps);
    double error = 0.0;
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      error = std::max(error, std::abs(curve.y[i] - std::sin(curve.x[i])));
    convergence.cell_size.push_back(turn / steps);
    convergence.error.push_back(error);
  }
  return convergence;
}

double angular_momentum(const Simulation& simulation) {
  const std::vector<double> m = masses(simulation);
  const std::vector<double> x = simulation.positions();
  const std::vector<double> v = simulation.field("velocity");
  double sum = 0.0;
  for (std::size_t p = 0; p < m.size(); ++p)
    sum += m[p] * (x[3 * p] * v[3 * p + 2] - x[3 * p + 2] * v[3 * p]);
  return sum;
}

/// A free elastic disc, its rim at 5 % of the wave speed: angular momentum over that at the start,
/// after each sixteenth of a turn.
render::Curve free_disc(VelocityTransfer transfer, const std::string& name) {
  constexpr int cells = 8, corners = 120, moments = 16;
  constexpr double radius = 1.0, h = radius / cells, density = 1000.0, omega = 0.5;
  Scene scene;
  scene.grid = plane_grid(h, {-1.5, -1.5}, {1.5, 1.5});
  scene.materials = {{"disc", density, 1e5 / 1.2, 0.25, LinearElastic{}}}; // 10 m/s
  scene.gravity = {0.0, 0.0, 0.0};
  scene.method.shape = ShapeFunctions::bspline;
  scene.method.transfer = transfer;
  if (transfer == VelocityTransfer::apic) scene.method.scheme = Scheme::usl;
  scene.timing.cfl = usual_cfl(scene.method);
  Region disc;
  disc.name = disc.material = "disc";
  for (int i = 0; i < corners; ++i)
    disc.polygon.push_back(
        {radius * std::cos(turn * i / corners), radius * std::sin(turn * i / corners)});
  scene.regions = {disc};
  const auto simulation = begin_with(scene, [](Snapshot& start) {
    for (std::size_t p = 0; p < start.gap.size(); ++p) {
      start.velocity[3 * p] = -omega * start.position[3 * p + 2];
      start.velocity[3 * p + 2] = omega * start.position[3 * p];
    }
  });
  const double start = angular_momentum(*simulation);
  render::Curve curve = {.label = name, .x = {0.0}, .y = {1.0}};
  for (int moment = 1; moment <= moments; ++moment) {
    run_until(*simulation, turn / omega * moment / moments);
    curve.x.push_back(static_cast<double>(moment) / moments);
    curve.y.push_back(angular_momentum(*simulation) / start);
  }
  return curve;
}

} // namespace

CaseReport rotation_case(Effort) {
  const Convergence convergence = shear_convergence();
  const std::vector<render::Curve> discs = {free_disc(VelocityTransfer::flip, "FLIP"),
                                            free_disc(VelocityTransfer::apic, "APIC"),
                                            free_disc(VelocityTransfer::aflip, "AFLIP")};
  CaseReport report;
  report.checks = {
      {"stress_after_a_turn", error_after_a_turn(), 0.0, 1e-10, Bound::absolute, "-",
       "a turn of 360 degrees takes the stress back", "3-D, 360 steps; parts of the stress"},
      {"simple_shear_order", convergence.order(), 2.0, 1.8, Bound::at_least, "-",
       "Jaumann law, tau = G sin(gamma), to gamma = 2 pi",
       "half of each increment is turned with the stress, half is added after the turn"},
      {"angular_momentum_kept", discs[2].y.back(), 1.0, 0.02, Bound::relative, "-",
       "nothing acts on a free disc",
       "AFLIP, B-splines, after a turn with 8 cells a radius; FLIP and APIC: see the figure"}};
  render::Curve exact = shear(400);
  exact.label = "G sin γ";
  for (std::size_t i = 0; i < exact.x.size(); ++i) exact.y[i] = std::sin(exact.x[i]);
  render::Curve coarse = shear(32);
  coarse.label = "32 steps";
  coarse.line = render::LineKind::none;
  coarse.marker = render::Marker::circle;
  report.figure = {{{exact, coarse},
                    {.x_name = "shear γ", .y_name = "shear stress / G", .title = "Simple shear"}},
                   {discs,
                    {.x_name = "turns",
                     .y_name = "angular momentum / that at the start",
                     .title = "Free disc"}}};
  report.caption = "Simple shear by the Jaumann law, and the angular momentum of a free disc.";
  report.convergence = {convergence};
  return report;
}

} // namespace scarp::bench
