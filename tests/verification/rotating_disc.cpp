// Rigid rotation: what stress and angular momentum make of it.
#include "core/lattice.hpp"
#include "core/stress_pass.hpp"
#include "tests/support/nodes.hpp"
#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double radius = 1.0, cell = 0.25;

/// The lattice squares whose centres lie in the disc, each with the velocity of the rotation
/// v = omega (z, -x) at its centre; z turns towards x.
Scene disc(double omega, Scheme scheme) {
  Scene scene;
  scene.grid = grid_2d(cell, {-1.5, -1.5}, {1.5, 1.5});
  scene.materials = {elastic("disc", 1000.0, 1e5 / 1.2, 0.25)}; // c = 10 m/s in uniaxial strain
  scene.gravity = {0.0, 0.0, 0.0};
  scene.method.scheme = scheme;
  const double a = 0.5 * cell;
  for (int i = -8; i < 8; ++i)
    for (int k = -8; k < 8; ++k) {
      const double x = (i + 0.5) * a, z = (k + 0.5) * a;
      if (x * x + z * z < radius * radius)
        scene.regions.push_back(box("square" + std::to_string(scene.regions.size()), "disc",
                                    {i * a, k * a}, {(i + 1) * a, (k + 1) * a},
                                    {omega * z, 0.0, -omega * x}));
    }
  return scene;
}

double angular_momentum(const Simulation& simulation) {
  const auto m = masses(simulation);
  const auto x = simulation.positions();
  const auto v = simulation.field("velocity");
  double total = 0.0;
  for (std::size_t p = 0; p < m.size(); ++p)
    total += m[p] * (x[3 * p + 2] * v[3 * p] - x[3 * p] * v[3 * p + 2]);
  return total;
}

} // namespace

/// Nodes driven in rigid rotation, points carried round a whole turn through many cells: the
/// velocity is linear, so its gradient is a pure spin to rounding wherever a point lies.  Stress
/// turns with the body, keeps its invariants, and no volume changes.
TEST(RotatingDisc, StressTurnsWithTheBody) {
  const Scene scene = disc(1.0, Scheme::musl);
  State<2> state(scene.grid, fill_regions<2>(scene));
  auto& points = state.particles;
  state.order.update(points);
  for (const std::size_t p : rows_of(points)) {
    const std::array<Real, 4> stress = {3e3, -2e3, 0.5e3, 0.7e3};
    for (std::size_t i = 0; i < 4; ++i) points.tau[i][p] = stress[i];
  }
  const int steps = 400;
  const double angle = 2.0 * pi / steps;
  const double spin =
      2.0 * std::tan(0.5 * angle); // of which Hughes and Winget's rotation is by `angle`
  int quarter = 0, crossings = 0;
  for (int step = 1; step <= steps; ++step) {
    for (const int at : active_nodes(state)) {
      const double x = -1.5 + cell * (at % 13), z = -1.5 + cell * (at / 13);
      state.nodal.nodes.v[0][at] = spin * z;
      state.nodal.nodes.v[1][at] = -spin * x;
    }
    stress_pass<2>(state, 0, ElasticModuli::from(1e8, 0.25), ElasticUpdate{}, false, 1.0);
    for (const std::size_t p : rows_of(points)) {
      const int before = state.grid.cell_of(points.position(p));
      const double x = points.x[0][p], z = points.x[1][p];
      points.x[0][p] = std::cos(angle) * x + std::sin(angle) * z;
      points.x[1][p] = std::cos(angle) * z - std::sin(angle) * x;
      crossings += state.grid.cell_of(points.position(p)) != before;
    }
    state.order.update(points);
    if (step % (steps / 4) != 0) continue;
    ++quarter;
    const bool across = quarter % 2 == 1; // xx <-> zz, xz changes sign with every quarter
    for (const std::size_t p : rows_of(points)) {
      // Rounding of a spin's symmetric part, 1e-16 a step,
      // times the stiffness 1e8 Pa: 1e-6 Pa in 400 steps.
      EXPECT_NEAR(points.tau[0][p], across ? -2e3 : 3e3, 1e-5);
      EXPECT_NEAR(points.tau[1][p], across ? 3e3 : -2e3, 1e-5);
      EXPECT_NEAR(points.tau[2][p], 0.5e3, 1e-5);
      EXPECT_NEAR(points.tau[3][p], across ? -0.7e3 : 0.7e3, 1e-5);
      EXPECT_NEAR(points.J[p], 1.0, 1e-12);
    }
  }
  EXPECT_EQ(quarter, 4);
  EXPECT_GT(crossings, 2000);
}

/// A free disc, rim speed 0.05 c.  Momentum stays zero to rounding.  Angular momentum is conserved
/// by the mapping to the nodes and by their forces, but not by the way back through linear
/// functions with lumped masses: with only four cells a radius, a quarter turn costs 3.3 %
/// (measured L/L0 USF 0.967, USL 0.974, MUSL 0.967). It is never gained.
TEST(RotatingDisc, FreeRotation) {
  for (const Scheme scheme : {Scheme::usf, Scheme::usl, Scheme::musl}) {
    const double omega = 0.5;
    const auto simulation = make_simulation(disc(omega, scheme));
    const auto start = simulation->positions();
    const double L0 = angular_momentum(*simulation);
    const double kinetic = simulation->energies().kinetic;
    EXPECT_NEAR(L0, 2.0 * kinetic / omega, 1e-9 * L0); // I omega = 2 (I omega^2 / 2) / omega
    double L = L0;
    for (int eighth = 1; eighth <= 2; ++eighth) {
      run_until(*simulation, eighth * 0.25 * pi / omega);
      EXPECT_LT(angular_momentum(*simulation), L * (1.0 + 1e-6));
      L = angular_momentum(*simulation);
    }
    EXPECT_GT(L / L0, 0.95);
    const double rim = mean_velocity(*simulation, 0);
    EXPECT_NEAR(rim, 0.0, 1e-13);
    EXPECT_NEAR(mean_velocity(*simulation, 2), 0.0, 1e-13);

    // It has turned: the angle between start and now that fits all points best,
    // 90 degrees less the lag.
    const auto x = simulation->positions();
    double along = 0.0, across = 0.0;
    for (std::size_t p = 0; p < simulation->points(); ++p) {
      along += x[3 * p] * start[3 * p] + x[3 * p + 2] * start[3 * p + 2];
      across += x[3 * p] * start[3 * p + 2] - x[3 * p + 2] * start[3 * p];
    }
    EXPECT_GT(std::atan2(across, along), 0.5 * pi - 0.13); // measured lag 0.095 .. 0.10 rad
    EXPECT_LT(std::atan2(across, along), 0.5 * pi);
  }
}
