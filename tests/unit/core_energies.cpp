// What becomes of the energy that a run puts in.
#include "core/simulation.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

using namespace scarp;
using namespace scarp::test;

/// gravity_work is the change of - sum m g . x, whatever the direction; the parts add up to it.
TEST(Energies, AddUp) {
  Scene scene = small_pile();
  scene.gravity = {1.5, 0.0, -9.0};
  scene.method.local_damping = 0.05;
  const auto simulation = make_simulation(scene);
  const auto start = simulation->positions();
  run_until(*simulation, 0.03);
  const Energies e = simulation->energies();
  const auto mass = masses(*simulation);
  const auto x = simulation->positions();
  const auto v = simulation->field("velocity");
  double work = 0.0, kinetic = 0.0;
  for (std::size_t p = 0; p < mass.size(); ++p) {
    work += mass[p] * (1.5 * (x[3 * p] - start[3 * p]) - 9.0 * (x[3 * p + 2] - start[3 * p + 2]));
    kinetic += 0.5 * mass[p] * (v[3 * p] * v[3 * p] + v[3 * p + 2] * v[3 * p + 2]);
  }
  EXPECT_GT(work, 1e-4);
  EXPECT_NEAR(e.gravity_work, work, 1e-12);
  EXPECT_NEAR(e.kinetic, kinetic, 1e-14);
  EXPECT_NEAR(e.gravity_work,
              e.kinetic + e.strain + e.plastic + e.damping + e.wall_friction + e.scheme_loss,
              1e-14);
  EXPECT_GT(e.plastic, 0.0);
  EXPECT_GT(e.damping, 0.0);
  EXPECT_EQ(e.wall_friction, 0.0) << "no such wall";
}

/// The work of gravity counts from time 0, as do the changes of kinetic energy: a flying block that
/// starts with 0.5 m v^2 loses nothing.
TEST(Energies, CountFromTimeZero) {
  const auto simulation = make_simulation(free_block({0.7, 0.0, 1.3}, {0.0, 0.0, -9.81}));
  const double mass = 1000.0 * 0.5 * 0.4;
  EXPECT_NEAR(simulation->energies().kinetic, 0.5 * mass * (0.49 + 1.69), 1e-10);
  EXPECT_EQ(simulation->energies().gravity_work, 0.0);
  EXPECT_EQ(simulation->energies().scheme_loss, 0.0);
  run_until(*simulation, 0.3);
  const Energies e = simulation->energies();
  // Symplectic Euler in a field g: x lags by dt v / 2, so the sum is off by m g^2 t dt / 2 at most.
  const double largest_step = 0.3 * 0.1 / 1.0;
  EXPECT_LT(std::abs(e.scheme_loss), 0.5 * mass * 9.81 * 9.81 * 0.3 * largest_step);
  EXPECT_NEAR(e.strain, 0.0, 1e-12);
}

/// A block in uniform motion: the nodes' kinetic energy, sum m_I v^2 / 2, is the points', in every
/// step, also when new nodes come into play.
TEST(Energies, GridKineticOfUniformMotion) {
  const auto simulation = make_simulation(free_block({0.7, 0.0, 1.3}, {0.0, 0.0, 0.0}));
  const double kinetic = simulation->energies().kinetic;
  EXPECT_GT(kinetic, 100.0);
  for (int step = 0; step < 60; ++step) {
    simulation->step(1.0);
    ASSERT_NEAR(simulation->energies().grid_kinetic, kinetic, 1e-9)
        << "step " << simulation->steps();
  }
}

/// What is unbalanced is what a friction side leaves of a force.  A film lies on one; damped by its
/// whole weight, it was thrown up with many times the energy that its settling gives.
TEST(LocalDamping, DoesNotThrowUpWhatLiesOnAFrictionSide) {
  Scene scene;
  scene.grid = grid_2d(0.1, {0.0, 0.0}, {1.0, 0.4});
  scene.grid.walls[2][0] = {WallKind::friction, 0.5};
  scene.gravity = {0.0, 0.0, -10.0};
  scene.materials = {elastic("clay", 1000.0, 1e5, 0.3)};
  scene.regions = {box("film", "clay", {0.3, 0.0}, {0.7, 0.004})};
  scene.method = method_of(Preset::accurate);
  scene.method.local_damping = 0.4;
  scene.timing.end_time = 1.0;
  const auto simulation = make_simulation(scene);
  double weight = 0.0;
  const auto density = simulation->field("density"), volume = simulation->field("volume");
  for (std::size_t p = 0; p < volume.size(); ++p) weight += 10.0 * density[p] * volume[p];
  for (int k = 0; k < 50; ++k) {
    simulation->step(1.0);
    const Energies e = simulation->energies();
    EXPECT_GE(e.gravity_work, 0.0) << "it does not rise";
    EXPECT_GE(e.damping, 0.0);
    EXPECT_LE(e.kinetic, weight * 0.004) << "of a fall through its thickness";
  }
}

/// Local damping takes the part alpha of every force: a block falls with (1 - alpha) g, up or down
/// alike. The first step, from rest, has no motion to act against: it may be taken as undamped.
TEST(LocalDamping, TakesItsPartOfTheForce) {
  const double alpha = 0.4, t = 0.1, dt = 1e-3;
  std::array<double, 2> velocity;
  for (std::size_t k = 0; k < 2; ++k) {
    const double gravity = k == 0 ? -9.81 : 9.81;
    Scene scene = free_block({0.0, 0.0, 0.0}, {0.0, 0.0, gravity});
    scene.method.local_damping = alpha;
    scene.timing.max_time_step = dt;
    const auto simulation = make_simulation(scene);
    run_until(*simulation, t);
    velocity[k] = mean_velocity(*simulation, 2);
    EXPECT_LE(std::abs(velocity[k] - (1.0 - alpha) * gravity * t), 1.001 * alpha * 9.81 * dt);
    const Energies e = simulation->energies();
    EXPECT_NEAR(e.damping / (e.damping + e.kinetic), alpha, 0.005) << "alpha of gravity's work";
  }
  EXPECT_NEAR(velocity[0], -velocity[1], 1e-12);
}
