// A body force that is a field.
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace scarp;
using namespace scarp::test;

namespace {

Scene block(ShapeFunctions shape, Scheme scheme) {
  Scene scene;
  scene.grid = grid_2d(0.1, {-1.0, -1.0}, {1.0, 1.0});
  scene.materials = {elastic("soil", 2000.0, 1e6, 0.3)};
  scene.gravity = {0.0, 0.0, 0.0};
  scene.method.shape = shape;
  scene.method.scheme = scheme;
  scene.regions = {box("block", "soil", {-0.25, -0.35}, {0.3, 0.2})};
  return scene;
}

} // namespace

/// A uniform field is gravity.
TEST(BodyForceField, UniformIsGravity) {
  for (const ShapeFunctions shape :
       {ShapeFunctions::linear, ShapeFunctions::gimp, ShapeFunctions::bspline})
    for (const Scheme scheme : {Scheme::usf, Scheme::usl, Scheme::musl}) {
      Scene with_gravity = block(shape, scheme);
      with_gravity.gravity = {1.5, 0.0, -3.0};
      Scene with_field = block(shape, scheme);
      with_field.body_force = [](const std::array<double, 3>&, double) {
        return std::array<double, 3>{1.5, 0.0, -3.0};
      };
      const auto a = make_simulation(with_gravity), b = make_simulation(with_field);
      run_until(*a, 0.1);
      run_until(*b, 0.1);
      const auto x = a->positions(), y = b->positions();
      for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], y[i], 1e-12);
    }
}

/// Momentum is the field's impulse: of b = (x, 0, t) with the points' places and times of each
/// step.
TEST(BodyForceField, GivesItsImpulse) {
  Scene scene = block(ShapeFunctions::bspline, Scheme::musl);
  scene.body_force = [](const std::array<double, 3>& x, double time) {
    return std::array<double, 3>{x[0], 0.0, 100.0 * time};
  };
  const auto simulation = make_simulation(scene);
  const std::vector<double> m = masses(*simulation);
  double impulse_x = 0.0, impulse_z = 0.0;
  for (int i = 0; i < 50; ++i) {
    const auto x = simulation->positions();
    const double time = simulation->time();
    const double dt = simulation->step(1e9);
    for (std::size_t p = 0; p < m.size(); ++p) {
      impulse_x += dt * m[p] * x[3 * p];
      impulse_z += dt * m[p] * 100.0 * time;
    }
  }
  EXPECT_NEAR(mean_velocity(*simulation, 0) * sum(m), impulse_x, 1e-9 * std::abs(impulse_x));
  EXPECT_NEAR(mean_velocity(*simulation, 2) * sum(m), impulse_z, 1e-9 * std::abs(impulse_z));
  EXPECT_GT(impulse_z, 0.0);
}
