// When the sides of the grid act on B-splines' nodes.
#include "core/contact_pass.hpp"
#include "core/lattice.hpp"
#include "core/node_pass.hpp"
#include "core/scatter_pass.hpp"
#include "core/simulation.hpp"
#include "core/spline_shape.hpp"
#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr double h = 0.5;
constexpr double g = 10.0;
constexpr double dt = 1e-3;
const Material rock = elastic("rock", 1000.0, 1e6, 0.3);

/// One point above the base of its grid, x to the right of the lower corner.
struct Point {
  State<2, SplineShape<2>> state;

  explicit Point(WallKind base, WallKind left = WallKind::free) : state(make(base, left)) {}

  /// Places in cells.
  bool base_acts(double x, double z, double v = 0.0, double body_force = 0.0) {
    const std::size_t row = rows_of(state.particles).front();
    state.particles.x[0][row] = x * h;
    state.particles.x[1][row] = z * h;
    state.particles.v[1][row] = v;
    state.order.update(state.particles);
    find_contacts_pass(state, body_force, dt);
    return !state.contacts[1][0].empty();
  }

 private:
  static State<2, SplineShape<2>> make(WallKind base, WallKind left) {
    Scene scene;
    scene.grid = grid_2d(h, {0.0, 0.0}, {6.0 * h, 4.0 * h});
    scene.grid.points_per_cell = 2;
    scene.grid.walls[2][0] = {base};
    scene.grid.walls[0][0] = {left};
    scene.materials = {rock};
    scene.regions = {box("rock", "rock", {0.0, 0.0}, {0.5 * h, 0.5 * h})};
    return State<2, SplineShape<2>>(scene.grid, fill_regions<2>(scene));
  }
};

} // namespace

/// From the touch of a point's edge until no point is in the first cell.
TEST(Contact, BeginsAtTheEdgeAndEndsWithTheCell) {
  for (const auto kind : {WallKind::fixed, WallKind::symmetry, WallKind::friction}) {
    Point point(kind);
    EXPECT_FALSE(point.base_acts(3.5, 0.9));
    EXPECT_FALSE(point.base_acts(3.5, 0.26));
    EXPECT_TRUE(point.base_acts(3.5, 0.25)) << "a quarter of a cell is half a point";
    EXPECT_TRUE(point.base_acts(3.5, 0.9)) << "what has touched is held";
    EXPECT_TRUE(point.base_acts(4.5, 0.9)) << "along the side as well";
    EXPECT_FALSE(point.base_acts(4.5, 1.1));
    EXPECT_FALSE(point.base_acts(4.5, 0.9)) << "and has come off";
  }
  EXPECT_FALSE(Point(WallKind::free).base_acts(3.5, 0.1));
}

/// A point that the step would bring to the side, with the velocity that it has or gets.
TEST(Contact, BeginsBeforeAPointPasses) {
  const double v = 0.5 * h / dt; // half a cell a step
  EXPECT_TRUE(Point(WallKind::fixed).base_acts(3.5, 0.7, -v));
  EXPECT_FALSE(Point(WallKind::fixed).base_acts(3.5, 0.8, -v));
  EXPECT_FALSE(Point(WallKind::fixed).base_acts(3.5, 0.3, v));
  EXPECT_TRUE(Point(WallKind::fixed).base_acts(3.5, 0.7, 0.0, v / dt));
}

/// In a corner, pairs of one side that are images at the other act with those that they are images
/// of: else their mass would be in no group of images.
TEST(Contact, CornersActTogether) {
  Point point(WallKind::symmetry, WallKind::fixed);
  EXPECT_FALSE(point.base_acts(0.1, 1.1));
  ASSERT_EQ(point.state.contacts[0][0].size(), 3U) << "rows 1 to 3";
  EXPECT_TRUE(point.base_acts(0.4, 0.2));
  EXPECT_EQ(point.state.contacts[0][0].size(), 3U) << "rows 0 to 2: row 0 acts with row 1";
}

/// An elastic layer that comes to rest on its base from a cell above it bears its weight where it
/// touches, and is not held before: the mean stress of its lowest row then hardly depends
/// on how stiff it is.  With a side that acts from a cell away it hovers at 0.96 cells with 26 q,
/// as q/2 (2K/q)^(1/3) says.
TEST(Contact, AStiffLayerDoesNotHover) {
  Scene scene;
  scene.grid = grid_2d(h, {0.0, 0.0}, {2.0 * h, 8.0 * h});
  scene.grid.points_per_cell = 2;
  scene.grid.walls[0] = {Wall{WallKind::symmetry}, Wall{WallKind::symmetry}};
  scene.grid.walls[2][0] = {WallKind::fixed};
  constexpr double weight = 1000.0 * g * 4.0 * h;
  scene.gravity = {0.0, 0.0, -g};
  scene.materials = {elastic("rock", 1000.0, 8e4 * weight, 0.0)};
  scene.regions = {box("rock", "rock", {0.0, h}, {2.0 * h, 5.0 * h})};
  scene.method = method_of(Preset::accurate);
  scene.method.local_damping = 0.5;
  scene.timing.end_time = 0.6;
  scene.timing.output_interval = 0.6;
  const auto simulation = make_simulation(scene);
  while (simulation->time() < scene.timing.end_time) simulation->step(scene.timing.end_time);
  const auto x = simulation->positions();
  const auto stress = simulation->field("stress");
  double lowest = x[2], most = 0.0;
  for (std::size_t p = 0; p < simulation->points(); ++p) {
    lowest = std::min(lowest, x[3 * p + 2]);
    most = std::max(most, -stress[6 * p + 2]);
  }
  EXPECT_NEAR(lowest, 0.25 * h, 0.01 * h);
  EXPECT_LT(most, 1.5 * weight);
}
