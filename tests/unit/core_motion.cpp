// The points' motion beside the sides of the grid.
#include "core/lattice.hpp"
#include "core/move_pass.hpp"
#include "core/reference/move_pass.hpp"
#include "core/spline_shape.hpp"

#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scarp {
namespace {

constexpr double h = 0.25;

Grid closed_grid(WallKind kind) {
  Grid grid = test::grid_2d(h, {1.0, -1.0}, {3.0, 1.0});
  for (const std::size_t axis : {0U, 2U}) grid.walls[axis] = {Wall{kind}, Wall{kind}};
  return grid;
}

/// One point at the lower left and one at the upper right corner, 0.1 cells from both sides, in a
/// field of one velocity.
template <class Shape> std::unique_ptr<State<2, Shape>> two_points(WallKind kind, double v) {
  Scene scene;
  scene.grid = closed_grid(kind);
  scene.materials = {test::elastic("rock", 1000.0, 1e6, 0.2)};
  scene.regions = {test::box("low", "rock", {1.0, -1.0}, {1.125, -0.875}),
                   test::box("high", "rock", {2.875, 0.875}, {3.0, 1.0})};
  auto state = std::make_unique<State<2, Shape>>(scene.grid, Particles<2>(fill_regions<2>(scene)));
  auto& points = state->particles;
  for (const std::size_t p : test::rows_of(points))
    for (std::size_t i = 0; i < 2; ++i)
      points.x[i][p] = points.x[i][p] < (i == 0 ? 2.0 : 0.0)
                           ? state->grid.lower[i] + 0.1 * h
                           : state->grid.lower[i] + (state->grid.cells[i] - 0.1) * h;
  state->order.update(points);
  for (auto& component : state->nodal.nodes.v) std::fill(component.begin(), component.end(), v);
  return state;
}

template <class Shape> void check_motion() {
  for (const double v : {-1.0, 1.0}) // a cell in 0.25 s
    for (const WallKind kind :
         {WallKind::fixed, WallKind::symmetry, WallKind::friction, WallKind::free}) {
      const auto state = two_points<Shape>(kind, v), plain = two_points<Shape>(kind, v);
      constexpr double dt = 0.05; // 0.2 cells
      const LostPoints lost = move_pass(*state, dt, [](std::size_t) {});
      const LostPoints of_plain = reference::move_pass(*plain, dt);
      EXPECT_EQ(lost.outside, of_plain.outside);
      EXPECT_EQ(lost.outside == no_point, kind != WallKind::free);
      ASSERT_EQ(test::rows_of(state->particles).size(), 2U);
      for (const std::size_t p : test::rows_of(state->particles))
        for (std::size_t i = 0; i < 2; ++i) {
          const double now = state->grid.scaled(state->particles.x[i][p], i), cells = 8.0;
          const bool low = now < 0.5 * cells, towards = low == (v < 0.0);
          double distance = towards ? 0.1 * std::exp(-0.2 / 0.1) : 0.1 + 0.2;
          if (towards && kind == WallKind::free) distance = 0.1; // where it was
          EXPECT_NEAR(low ? now : cells - now, distance, 1e-12) << low << v;
          EXPECT_DOUBLE_EQ(state->particles.x[i][p], plain->particles.x[i][p]);
        }
    }
}

} // namespace

TEST(Motion, DoesNotPassClosedSides) {
  check_motion<LinearShape<2>>();
  check_motion<SplineShape<2>>();
}

/// x = 1 to 3 m, a cell is 0.25 m.
TEST(Motion, GoesItsPathBesideASide) {
  const GridIndex<2> grid(closed_grid(WallKind::fixed));
  EXPECT_EQ(short_of_sides(grid, 0, 1.1, 1.05), 1.05) << "on this side of it: the step itself";
  EXPECT_NEAR(short_of_sides(grid, 0, 1.1, 0.95), 1.0 + 0.1 * std::exp(-1.5), 1e-12);
  EXPECT_NEAR(short_of_sides(grid, 1, 0.9, 1.1), 1.0 - 0.1 * std::exp(-2.0), 1e-12);
  EXPECT_EQ(short_of_sides(grid, 0, 1.0, 0.9), 1.0) << "on the side itself";
}

/// The time step allows no such steps: what makes them is a fault to be told of.
TEST(Motion, PassesASideInAStepThatIsTooLong) {
  const GridIndex<2> grid(closed_grid(WallKind::fixed));
  EXPECT_EQ(short_of_sides(grid, 0, 1.1, 0.8), 0.8) << "1.2 cells";
  EXPECT_EQ(short_of_sides(grid, 1, 0.9, 1.2), 1.2);
  EXPECT_TRUE(std::isnan(short_of_sides(grid, 0, 1.1, std::nan(""))));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(short_of_sides(grid, 0, 1.1, -infinity), -infinity);
}

} // namespace scarp
