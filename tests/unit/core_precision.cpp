// Single precision: how far results are from double, that the origin does not matter, what is
// refused.
#include "core/error.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

using namespace scarp;
using namespace scarp::test;

namespace {

/// A block of rods that collapses; `origin` moves it along x, in m.
Scene block(double origin, ShapeFunctions shape) {
  Scene scene;
  scene.grid = grid_2d(1.0 / 64, {origin, 0.0}, {origin + 1.0, 0.375});
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.materials = {rods()};
  scene.regions = {box("block", "rods", {origin, 0.0}, {origin + 0.25, 0.25})};
  scene.method.shape = shape;
  return scene;
}

std::vector<double> velocities(Scene scene, Precision precision, int steps) {
  scene.method.precision = precision;
  const auto simulation = make_simulation(scene);
  for (int k = 0; k < steps; ++k) simulation->step(std::numeric_limits<double>::infinity());
  return simulation->field("velocity");
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

} // namespace

TEST(SinglePrecision, IsNearDouble) {
  for (const auto& [shape, transfer] :
       {std::pair{ShapeFunctions::linear, VelocityTransfer::flip},
        std::pair{ShapeFunctions::bspline, VelocityTransfer::flip},
        std::pair{ShapeFunctions::bspline, VelocityTransfer::apic}}) {
    Scene scene = block(0.0, shape);
    scene.method.transfer = transfer;
    const auto exact = velocities(scene, Precision::double_precision, 50);
    const auto rough = velocities(scene, Precision::single, 50);
    const double fastest = std::abs(*std::ranges::min_element(exact)); // downwards
    EXPECT_GT(fastest, 0.05);
    EXPECT_GT(largest_difference(exact, rough), 0.0) << "another arithmetic";
    EXPECT_LT(largest_difference(exact, rough), 1e-3 * fastest);
  }
}

/// Positions are doubles: 2^17 m away, where floats are 8 mm apart, nothing changes in the passes,
/// since the shift is exact in the doubles.
TEST(SinglePrecision, TheOriginDoesNotMatter) {
  const auto here = velocities(block(0.0, ShapeFunctions::linear), Precision::single, 50);
  const auto away = velocities(block(131072.0, ShapeFunctions::linear), Precision::single, 50);
  EXPECT_LT(largest_difference(here, away), 1e-6);
}

/// A million cells away from the lower side floats are 1/16 of a cell apart; a ten-thousandth of a
/// cell still decides whether a point leaves the grid.
TEST(SinglePrecision, TheSideOfTheGridIsWhereItIs) {
  constexpr double cells = 1 << 20;
  Scene scene;
  scene.grid = grid_2d(1.0, {0.0, 0.0}, {cells, 2.0});
  scene.gravity = {};
  scene.materials = {elastic("m", 1000.0, 1e-6, 0.0)};
  // Points at 1/4 and 3/4 of the cells.
  scene.regions = {box("b", "m", {cells - 2.0, 0.0}, {cells, 1.0}, {1.0, 0.0, 0.0})};
  scene.method.precision = Precision::single;
  scene.timing.cfl = 0.5;
  scene.timing.max_time_step = 0.2499;
  EXPECT_NO_THROW(make_simulation(scene)->step(1.0));
  scene.timing.max_time_step = 0.2501;
  EXPECT_THROW(make_simulation(scene)->step(1.0), RunError);
}

TEST(SinglePrecision, OtherFunctionsAreRefused) {
  Scene scene = block(0.0, ShapeFunctions::gimp);
  scene.method.precision = Precision::single;
  EXPECT_THROW(make_simulation(scene), SetupError);
}
