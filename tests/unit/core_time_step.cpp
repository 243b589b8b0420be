// The bounds behind the step.
#include "core/gimp_shape.hpp"
#include "core/linear_shape.hpp"
#include "core/simulation.hpp"
#include "core/spline_shape.hpp"
#include "core/time_step.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

using namespace scarp;
using namespace scarp::test;

namespace {

/// sum_k w_k'^2 / w_k along an axis, 1/cell^2, in the middle of a grid.
template <class Shape> double gradient_sum(double xi, double half_point) {
  const GridIndex<2> grid(grid_2d(1.0, {0.0, 0.0}, {9.0, 9.0}), Shape::layout);
  const StencilCell<2> cell(grid, grid.along(4 + 4 * grid.cell_stride[1]), half_point);
  // A point in the middle along z, where the functions do not depend on x: their sum over z.
  const Shape shape({xi, 0.5}, cell);
  std::map<std::size_t, std::array<double, 2>> by_x; // place along x: sums of N and dN/dx
  for (std::size_t c = 0; c < Shape::nodes; ++c) {
    auto& [N, dN] = by_x[Shape::places(c)[0]];
    N += shape.N[c];
    dN += shape.dN[c][0];
  }
  double sum = 0.0;
  for (const auto& [place, values] : by_x)
    if (values[0] > 0.0) sum += values[1] * values[1] / values[0];
  return sum;
}

template <class Shape> double largest_gradient_sum(double half_point) {
  double most = 0.0;
  for (int i = 1; i < 1000; ++i) most = std::max(most, gradient_sum<Shape>(1e-3 * i, half_point));
  return most;
}

} // namespace

/// A bound is one, and no larger than it has to be.
TEST(TimeStep, GradientBoundsHoldEverywhereAndAreReached) {
  EXPECT_LE(largest_gradient_sum<SplineShape<2>>(0.25), 6.0);
  EXPECT_GT(largest_gradient_sum<SplineShape<2>>(0.25), 5.9);
  for (const double l : {0.125, 0.25, 0.5}) {
    const double bound = GimpShape<2>::gradient_bound(l);
    EXPECT_LE(largest_gradient_sum<GimpShape<2>>(l), bound * (1.0 + 1e-12)) << l;
    EXPECT_GT(largest_gradient_sum<GimpShape<2>>(l), 0.95 * bound) << l;
  }
  EXPECT_GT(largest_gradient_sum<LinearShape<2>>(0.25), 900.0) << "linear functions have none";
}

/// nu = 0: lambda = 0, so the volumetric modulus is 2 G = E.
TEST(TimeStep, CriticalSpeedsByHand) {
  const auto moduli = ElasticModuli::from(4e6, 0.0);
  const double c = std::sqrt(4e6 / 1000.0);
  EXPECT_NEAR((critical_speed<2, LinearShape<2>>(moduli, 1000.0, 0.25)), c, 1e-12 * c);
  EXPECT_NEAR((critical_speed<2, SplineShape<2>>(moduli, 1000.0, 0.25)), c * std::sqrt(1.5),
              1e-12 * c);
  // nu = 1/3: lambda = 2 G = 3/4 E; plane strain 2 lambda + 2 G = 9/4 E, 3-D 3 E.
  const auto third = ElasticModuli::from(4e6, 1.0 / 3.0);
  EXPECT_NEAR((critical_speed<2, SplineShape<2>>(third, 1000.0, 0.25)), c * std::sqrt(1.5 * 2.25),
              1e-9 * c);
  EXPECT_NEAR((critical_speed<3, SplineShape<3>>(third, 1000.0, 0.25)), c * std::sqrt(1.5 * 3.0),
              1e-9 * c);
}

/// 4 m high and 2 m wide with 10 m/s2 downwards, three times that in a stage: 4e4 and 1.2e5 Pa, of
/// M = 4e4 Pa.  It is as stiff as it is heavy where it is heavier than stiff.
TEST(TimeStep, CountsAWeightThatCrushes) {
  Scene scene;
  scene.grid = grid_2d(0.5, {0.0, 0.0}, {8.0, 8.0});
  scene.gravity = {0.0, 0.0, -10.0};
  scene.materials = {elastic("mud", 1000.0, 4e4, 0.0)};
  scene.regions = {box("hill", "mud", {1.0, 0.0}, {3.0, 4.0})};
  const Stage own;
  EXPECT_DOUBLE_EQ(crushing(scene, scene.regions[0], own), 1.0);
  Stage spun;
  spun.gravity.points = {{0.0, 1.0}, {1.0, -3.0}};
  EXPECT_DOUBLE_EQ(crushing(scene, scene.regions[0], spun), std::sqrt(3.0));
  const double stable = make_simulation(scene)->stable_time_step();
  spun.name = "spun";
  spun.duration = 1.0;
  scene.stages = {spun};
  EXPECT_LT(make_simulation(scene)->stable_time_step(), 0.7 * stable);
}

/// dt = h / (c + s v), and sqrt(h / s b) if that is less.
TEST(TimeStep, IsThatOfWavesMotionAndGravity) {
  EXPECT_DOUBLE_EQ(critical_step(0.5, 8.0, 1.0, 0.0, 2.0), 0.05);
  EXPECT_DOUBLE_EQ(critical_step(0.5, 8.0, 1.0, 1.0, 2.0), 0.05);
  EXPECT_DOUBLE_EQ(critical_step(0.5, 8.0, 1.0, 1e4, 2.0), 0.005);
}

/// What the grid does not see of velocities dies off as flip^(t / 0.3 h/c), whatever the steps: two
/// points a cell between two walls, to and fro, whose momenta cancel at every node.
TEST(TimeStep, BlendsFlipInTime) {
  constexpr double v = 1e-9, flip = 0.9;
  Scene scene;
  scene.grid = grid_2d(1.0, {0.0, 0.0}, {2.0, 2.0});
  scene.grid.walls[0][0].kind = scene.grid.walls[0][1].kind = WallKind::symmetry;
  scene.gravity = {0.0, 0.0, 0.0};
  scene.materials = {elastic("foam", 1000.0, 1e3, 0.2)};
  for (int k = 0; k < 4; ++k)
    scene.regions.push_back(box("column " + std::to_string(k), "foam", {0.5 * k, 0.0},
                                {0.5 * (k + 1), 2.0}, {k % 2 == 0 ? v : -v, 0.0, 0.0}));
  scene.method.flip = flip;
  scene.timing.end_time = 1e9;
  const auto left_after = [&](double cfl, double longest, int steps) {
    scene.timing.cfl = cfl;
    scene.timing.max_time_step = longest;
    const auto simulation = make_simulation(scene);
    for (int k = 0; k < steps; ++k) simulation->step(scene.timing.end_time);
    const std::vector<double> now = component_of(simulation->field("velocity"), 3, 0);
    EXPECT_NEAR(std::abs(now.front()), std::abs(now.back()), 1e-6 * v);
    return std::abs(now.front()) / v;
  };
  constexpr double any = std::numeric_limits<double>::infinity();
  const double left = std::pow(flip, 8);
  EXPECT_NEAR(left_after(0.3, any, 8), left, 1e-6);
  EXPECT_NEAR(left_after(0.15, any, 16), left, 1e-6);
  EXPECT_NEAR(left_after(0.6, any, 4), left, 1e-6);
  scene.timing.cfl = 0.3;
  const double half_step = 0.5 * make_simulation(scene)->stable_time_step();
  EXPECT_NEAR(left_after(0.9, half_step, 16), left, 1e-6);
}
