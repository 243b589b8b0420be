// An elastic block on a wall with Coulomb friction.
//
// Each node on the wall gets the normal impulse P >= 0 and, while it slides in the direction +x,
// the tangential one -mu P.  Summed over nodes and steps, for the block's mean velocity:
//   m v_z = - m g_n t + sum P,   m v_x = m v_0 + m g_t t - mu sum P
//   =>  v_x + mu v_z = v_0 + (g_t - mu g_n) t                                                  (*)
// whatever the block's vibration: exact to rounding.  With v_z -> 0 it is Coulomb's law for the
// whole block, a = g_t - mu g_n.
//
// A node that sticks for a moment takes less than mu P, so in general the left side is the greater:
// never less, that would be more friction than Coulomb's.  Nodes stick where the block's front has
// just reached them and they carry next to no mass: first after 0.0167 s, when the front's points,
// 25 mm from the next cell, enter it at 1.5 m/s.
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr double g = 10.0; // m/s2
constexpr double block_mass = 1000.0 * 0.4 * 0.2;

Scene block(double friction, double v_0, double sine, double cosine) {
  Scene scene;
  scene.grid = grid_2d(0.1, {0.0, 0.0}, {4.0, 0.8});
  scene.grid.walls[2][0] = {WallKind::friction, friction};
  scene.materials = {elastic("block", 1000.0, 1e6, 0.2)};
  scene.gravity = {g * sine, 0.0, -g * cosine}; // the slope tilts gravity
  scene.regions = {box("block", "block", {0.5, 0.0}, {0.9, 0.2}, {v_0, 0.0, 0.0})};
  return scene;
}

double centre(const Simulation& simulation, std::size_t axis) {
  const auto m = masses(simulation);
  const auto x = component_of(simulation.positions(), 3, axis);
  double moment = 0.0;
  for (std::size_t p = 0; p < m.size(); ++p) moment += m[p] * x[p];
  return moment / sum(m);
}

} // namespace

/// Level ground, mu = 0.3, from 1.5 m/s: a = -3 m/s2.
TEST(SlidingBlock, CoulombDecelerationIsExact) {
  const double mu = 0.3, v_0 = 1.5;
  const auto simulation = make_simulation(block(mu, v_0, 0.0, 1.0));
  const double x_0 = centre(*simulation, 0), z_0 = centre(*simulation, 2);
  double longest = 0.0;
  while (simulation->time() < 0.25) {
    longest = std::max(longest, simulation->step(0.25));
    const double t = simulation->time();
    const double balance = mean_velocity(*simulation, 0) + mu * mean_velocity(*simulation, 2);
    ASSERT_GT(balance - (v_0 - mu * g * t), -1e-12) << "(*) at " << t << " s";
    ASSERT_LT(balance - (v_0 - mu * g * t), t < 0.016 ? 1e-12 : 2e-3) << "(*) at " << t << " s";
    // Its time integral; symplectic Euler lags by at most a dt t / 2.
    const double path = centre(*simulation, 0) - x_0 + mu * (centre(*simulation, 2) - z_0);
    ASSERT_NEAR(path, v_0 * t - 0.5 * mu * g * t * t, 0.51 * mu * g * t * longest + 2e-3 * t);
  }
}

/// A slope of 3:4 (sin 0.6, cos 0.8), mu = 0.3: a = 10 (0.6 - 0.3 * 0.8) = 3.6 m/s2.
TEST(SlidingBlock, AccelerationOnASlope) {
  const double mu = 0.3, v_0 = 1.5;
  const auto simulation = make_simulation(block(mu, v_0, 0.6, 0.8));
  while (simulation->time() < 0.25) {
    simulation->step(0.25);
    const double t = simulation->time();
    const double balance = mean_velocity(*simulation, 0) + mu * mean_velocity(*simulation, 2);
    ASSERT_GT(balance - (v_0 + 3.6 * t), -1e-12) << "(*) at " << t << " s";
    ASSERT_LT(balance - (v_0 + 3.6 * t), t < 0.016 ? 1e-12 : 2e-3) << "(*) at " << t << " s";
  }
}

/// It stops after v_0^2 / (2 mu g) = 0.375 m, at 0.5 s, and stays.  Friction has then turned the
/// whole of m v_0^2 / 2 into heat; what the points vibrate with is left, a few per cent.
TEST(SlidingBlock, StopsAndStays) {
  const double mu = 0.3, v_0 = 1.5;
  const auto simulation = make_simulation(block(mu, v_0, 0.0, 1.0));
  const double x_0 = centre(*simulation, 0);
  run_until(*simulation, 0.6);
  const double path = centre(*simulation, 0) - x_0;
  EXPECT_NEAR(path, 0.375, 0.03 * 0.375); // measured 0.3743
  const double kinetic = 0.5 * block_mass * v_0 * v_0;
  EXPECT_GT(simulation->energies().wall_friction, 0.9 * kinetic);
  EXPECT_LT(simulation->energies().wall_friction, 1.05 * kinetic);
  run_until(*simulation, 0.8);
  EXPECT_NEAR(centre(*simulation, 0) - x_0, path, 0.01 * 0.375);
  EXPECT_LT(simulation->energies().wall_friction, 1.05 * kinetic) << "at rest nothing rubs";
}

/// On a slope of 3:4 with mu = 1.5, twice the tangent, and damped, the block sticks: it shears
/// elastically by about tau H / G = 1.2 kPa * 0.2 m / 0.42 MPa = 0.6 mm, and no more.
TEST(SlidingBlock, SticksOnAGentleSlope) {
  Scene scene = block(1.5, 0.0, 0.6, 0.8);
  scene.method.local_damping = 0.3;
  const auto simulation = make_simulation(scene);
  const double x_0 = centre(*simulation, 0);
  run_until(*simulation, 0.4);
  const double first = centre(*simulation, 0) - x_0;
  EXPECT_GT(first, 0.0);
  EXPECT_LT(first, 2e-3);
  run_until(*simulation, 0.8);
  EXPECT_NEAR(centre(*simulation, 0) - x_0, first, 1e-4) << "it does not creep";
}

/// A smooth wall only carries.  A block laid down at rest and unstressed has no energy but its
/// height's, so without damping its centre can never rise above where it was; and a wall without
/// friction takes no heat.
TEST(SlidingBlock, SmoothWallGivesAndTakesNoEnergy) {
  for (const double v_0 : {0.0, 1.5}) {
    const auto simulation = make_simulation(block(0.0, v_0, 0.0, 1.0));
    const double z_0 = centre(*simulation, 2);
    const double dip =
        1000.0 * g * 0.2 * 0.2 / (2.0 * 1.1e6); // m, of the top at rest: rho g H^2 / 2M
    while (simulation->time() < 0.8) {
      simulation->step(0.8);
      ASSERT_LT(centre(*simulation, 2) - z_0, 0.3 * dip) << "at " << simulation->time() << " s";
    }
    EXPECT_NEAR(mean_velocity(*simulation, 0), v_0, 1e-12);
    const Energies e = simulation->energies();
    // The scale is the work of gravity over the dip, half of m g dip: 0.07 J.
    EXPECT_NEAR(e.wall_friction, 0.0, 0.5 * block_mass * g * dip);
    EXPECT_GT(e.scheme_loss, -0.5 * block_mass * g * dip) << "no energy out of nothing";
  }
}
