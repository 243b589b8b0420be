#include "core/simulation.hpp"
#include "core/walls.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// 4 x 3 cells of 1 m from (0, 0) in plane strain; 4 x 2 x 3 in 3-D.
Scene scene_2d() {
  Scene scene;
  scene.grid = grid_2d(1.0, {0.0, 0.0}, {4.0, 3.0});
  return scene;
}

Scene scene_3d() {
  Scene scene;
  scene.grid = grid_3d(1.0, {0.0, 0.0, 0.0}, {4.0, 2.0, 3.0});
  return scene;
}

int node(int i, int k) { return i + 5 * k; }
int node(int i, int j, int k) { return i + 5 * (j + 3 * k); }

template <int Dim> struct Fixture {
  GridIndex<Dim> grid;
  Walls<Dim> walls;
  explicit Fixture(const Scene& scene) : grid(scene.grid), walls(scene, grid) {}

  Vec<Dim> constrained(int at, Vec<Dim> v) const {
    walls.constrain(at, v);
    return v;
  }
  Vec<Dim> resisted(int at, Vec<Dim> v) const {
    for (const auto& side : walls.friction())
      if (on(side, at)) v = side.resist(v);
    return v;
  }
  Vec<Dim> held_back(int at, Vec<Dim> v) const {
    for (const auto& side : walls.friction())
      if (on(side, at)) v = side.hold_back(v);
    return v;
  }

 private:
  bool on(const auto& side, int at) const {
    const int along = grid.node_along(at, side.axis);
    return along == (side.side == 0 ? 0 : grid.cells[side.axis]);
  }
};

Wall friction(double coefficient) { return {WallKind::friction, coefficient}; }

} // namespace

/// Nodes that a fixed left side, a symmetry side on the right and a gate at x = 2 hold along x, by
/// layout of the nodes; B-splines have images at sides instead.
TEST(Walls, HoldTheNodesThatMatterOnTheirPlane) {
  Scene scene = scene_2d();
  scene.grid.walls[0][0].kind = WallKind::fixed;
  scene.grid.walls[0][1].kind = WallKind::symmetry;
  scene.gates = {{"gate", 0, 2.0, 1.0}};
  const auto held = [&](NodeLayout layout) {
    const GridIndex<2> grid(scene.grid, layout);
    const Walls<2> walls(scene, grid);
    std::vector<int> along;
    for (int i = 0; i < grid.nodes[0]; ++i) {
      Vec<2> v = {1.0, 1.0};
      walls.constrain(i + grid.node_stride[1], v);
      if (v[0] == 0.0) along.push_back(i);
    }
    return along;
  };
  EXPECT_EQ(held(NodeLayout::corner), (std::vector<int>{0, 2, 4}));
  EXPECT_EQ(held(NodeLayout::padded), (std::vector<int>{0, 1, 3, 5, 6}))
      << "node 1 is on the side, node 0 beyond it";
  EXPECT_EQ(held(NodeLayout::spline), (std::vector<int>{2, 3}))
      << "two control points hold an inner plane";
  scene.gates = {{"gate", 0, 1.0, 1.0}};
  EXPECT_EQ(held(NodeLayout::spline), (std::vector<int>{0, 1, 2}))
      << "the image of a held one is held";
}

/// What a static solve may move: nothing that is held, and at friction sides nothing across them.
TEST(Walls, DegreesOfFreedomAreTheNodesOwn) {
  Scene scene = scene_2d();
  scene.grid.walls[0][0].kind = WallKind::fixed;
  scene.grid.walls[2][0] = friction(0.5);
  scene.gates = {{"gate", 0, 2.0, 1.0}};
  const Fixture<2> fixture(scene);
  const auto moves = [&](int at) {
    std::array<bool, 2> free = {};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto [of, sign] = fixture.walls.degree_of_freedom(at, i);
      EXPECT_EQ(of, at);
      EXPECT_TRUE(sign == 0.0 || sign == 1.0);
      free[i] = sign != 0.0;
    }
    return free;
  };
  EXPECT_EQ(moves(node(0, 2)), (std::array{false, false})) << "fixed";
  EXPECT_EQ(moves(node(1, 0)), (std::array{true, false})) << "friction";
  EXPECT_EQ(moves(node(2, 1)), (std::array{false, true})) << "a closed gate";
  EXPECT_EQ(moves(node(2, 0)), (std::array{false, false})) << "both";
  EXPECT_EQ(moves(node(3, 1)), (std::array{true, true}));
}

TEST(Walls, FreeSidesDoNothing) {
  const Fixture<2> free(scene_2d());
  for (int at = 0; at < 20; ++at) {
    EXPECT_EQ(free.constrained(at, {1.0, -2.0}), (Vec<2>{1.0, -2.0}));
    EXPECT_EQ(free.resisted(at, {1.0, -2.0}), (Vec<2>{1.0, -2.0}));
    EXPECT_EQ(free.held_back(at, {1.0, -2.0}), (Vec<2>{1.0, -2.0}));
  }
}

/// Each side acts on its own nodes only.
TEST(Walls, FixedAndSymmetrySides2d) {
  for (const auto kind : {WallKind::fixed, WallKind::symmetry})
    for (const std::size_t axis : {0U, 2U})
      for (std::size_t side = 0; side < 2; ++side) {
        Scene scene = scene_2d();
        scene.grid.walls[axis][side].kind = kind;
        const Fixture<2> fixture(scene);
        for (int k = 0; k <= 3; ++k)
          for (int i = 0; i <= 4; ++i) {
            const bool on = axis == 0 ? i == (side == 0 ? 0 : 4) : k == (side == 0 ? 0 : 3);
            Vec<2> expected = {1.0, -2.0};
            if (on && kind == WallKind::fixed) expected = {0.0, 0.0};
            if (on && kind == WallKind::symmetry) expected[axis == 0 ? 0 : 1] = 0.0;
            EXPECT_EQ(fixture.constrained(node(i, k), {1.0, -2.0}), expected) << i << " " << k;
          }
      }
}

TEST(Walls, FixedAndSymmetrySides3d) {
  for (const auto kind : {WallKind::fixed, WallKind::symmetry})
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t side = 0; side < 2; ++side) {
        Scene scene = scene_3d();
        scene.grid.walls[axis][side].kind = kind;
        const Fixture<3> fixture(scene);
        const std::array<int, 3> last = {4, 2, 3};
        for (int k = 0; k <= 3; ++k)
          for (int j = 0; j <= 2; ++j)
            for (int i = 0; i <= 4; ++i) {
              const bool on = std::array{i, j, k}[axis] == (side == 0 ? 0 : last[axis]);
              Vec<3> expected = {1.0, -2.0, 3.0};
              if (on && kind == WallKind::fixed) expected = {0.0, 0.0, 0.0};
              if (on && kind == WallKind::symmetry) expected[axis] = 0.0;
              EXPECT_EQ(fixture.constrained(node(i, j, k), {1.0, -2.0, 3.0}), expected);
            }
      }
}

/// Where sides meet, both act; fixed wins over symmetry whichever comes first.
TEST(Walls, Corners) {
  Scene scene = scene_2d();
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[0][1].kind = WallKind::fixed;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.grid.walls[2][1].kind = WallKind::symmetry;
  const Fixture<2> fixture(scene);
  for (const int corner : {node(0, 0), node(4, 0), node(0, 3), node(4, 3)})
    EXPECT_EQ(fixture.constrained(corner, {1.0, -2.0}), (Vec<2>{0.0, 0.0}));
  EXPECT_EQ(fixture.constrained(node(0, 1), {1.0, -2.0}), (Vec<2>{0.0, -2.0}));
  EXPECT_EQ(fixture.constrained(node(1, 3), {1.0, -2.0}), (Vec<2>{1.0, 0.0}));
}

/// Coulomb: stopping the motion into the wall, 2 m/s, takes the normal impulse 2 m; the tangential
/// one is at most mu times it, 0.5 * 2 m = 1 m, so a slip of 3 m/s loses 1 m/s.
TEST(Walls, CoulombFriction2d) {
  Scene scene = scene_2d();
  scene.grid.walls[2][0] = friction(0.5);
  const Fixture<2> fixture(scene);
  const int at = node(2, 0);
  const auto near = [](const Vec<2>& v, const Vec<2>& expected) {
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(v[i], expected[i], 1e-15);
  };
  near(fixture.resisted(at, {3.0, -2.0}), {2.0, 0.0});
  near(fixture.resisted(at, {-3.0, -2.0}), {-2.0, 0.0});
  near(fixture.resisted(at, {0.9, -2.0}), {0.0, 0.0}); // sticks, and does not turn round
  near(fixture.resisted(at, {0.0, -2.0}), {0.0, 0.0});
  near(fixture.resisted(at, {3.0, 2.0}), {3.0, 2.0}); // leaves the wall freely
  near(fixture.resisted(at, {3.0, 0.0}), {3.0, 0.0}); // no pressure, no friction
  near(fixture.held_back(at, {3.0, -2.0}), {3.0, 0.0});
  near(fixture.held_back(at, {3.0, 2.0}), {3.0, 2.0});
  near(fixture.resisted(node(2, 1), {3.0, -2.0}), {3.0, -2.0}); // one node off the wall
  near(fixture.constrained(at, {3.0, -2.0}), {3.0, -2.0});      // no constraint: an impulse
}

/// At an upper side "into" is the other way.
TEST(Walls, CoulombFrictionOnUpperSides) {
  Scene scene = scene_2d();
  scene.grid.walls[0][1] = friction(0.5);
  const Fixture<2> fixture(scene);
  EXPECT_EQ(fixture.resisted(node(4, 1), {2.0, 3.0}), (Vec<2>{0.0, 3.0 * (1.0 - 1.0 / 3.0)}));
  EXPECT_EQ(fixture.resisted(node(4, 1), {-2.0, 3.0}), (Vec<2>{-2.0, 3.0}));
}

/// In 3-D friction acts against the whole slip (3, 4), 5 m/s:
/// it loses 0.5 * 2 = 1 m/s in its direction.
TEST(Walls, CoulombFriction3d) {
  Scene scene = scene_3d();
  scene.grid.walls[2][0] = friction(0.5);
  const Fixture<3> fixture(scene);
  const Vec<3> v = fixture.resisted(node(1, 1, 0), {3.0, 4.0, -2.0});
  EXPECT_NEAR(v[0], 2.4, 1e-15);
  EXPECT_NEAR(v[1], 3.2, 1e-15);
  EXPECT_EQ(v[2], 0.0);
}

TEST(Walls, FrictionBesideSymmetry) {
  Scene scene = scene_3d();
  scene.grid.walls[2][0] = friction(0.5);
  scene.grid.walls[1][0].kind = WallKind::symmetry;
  const Fixture<3> fixture(scene);
  const Vec<3> v = fixture.constrained(node(1, 0, 0), {3.0, 4.0, -2.0});
  EXPECT_EQ(fixture.resisted(node(1, 0, 0), v), (Vec<3>{2.0, 0.0, 0.0}));
}

TEST(Walls, FrictionInACorner) {
  Scene scene = scene_2d();
  scene.grid.walls[2][0] = friction(0.5);
  scene.grid.walls[0][0] = friction(0.25);
  const Fixture<2> fixture(scene);
  EXPECT_EQ(fixture.resisted(node(0, 0), {-1.0, -1.0}), (Vec<2>{0.0, 0.0}));
  EXPECT_EQ(fixture.resisted(node(0, 0), {1.0, -1.0}), (Vec<2>{0.5, 0.0})); // only the base is hit
  EXPECT_EQ(fixture.resisted(node(0, 0), {1.0, 1.0}), (Vec<2>{1.0, 1.0}));
}

TEST(Walls, GatesHoldUntilTheirTime) {
  Scene scene = scene_2d();
  scene.gates = {{"late", 0, 2.0, 0.5}, {"early", 2, 1.0, 0.25}};
  Fixture<2> fixture(scene);
  EXPECT_EQ(fixture.walls.next_opening(0.0), 0.25);
  EXPECT_EQ(fixture.walls.next_opening(0.25), 0.5);
  EXPECT_EQ(fixture.walls.next_opening(0.5), infinity);

  fixture.walls.open_gates(0.2499);
  EXPECT_EQ(fixture.constrained(node(2, 0), {1.0, -2.0}), (Vec<2>{0.0, -2.0}));
  EXPECT_EQ(fixture.constrained(node(0, 1), {1.0, -2.0}), (Vec<2>{1.0, 0.0}));
  EXPECT_EQ(fixture.constrained(node(2, 1), {1.0, -2.0}), (Vec<2>{0.0, 0.0}));
  EXPECT_EQ(fixture.constrained(node(1, 0), {1.0, -2.0}), (Vec<2>{1.0, -2.0}));

  fixture.walls.open_gates(0.25);
  EXPECT_EQ(fixture.constrained(node(0, 1), {1.0, -2.0}), (Vec<2>{1.0, -2.0}));
  EXPECT_EQ(fixture.constrained(node(2, 1), {1.0, -2.0}), (Vec<2>{0.0, -2.0}));

  fixture.walls.open_gates(0.5);
  EXPECT_EQ(fixture.constrained(node(2, 1), {1.0, -2.0}), (Vec<2>{1.0, -2.0}));
}

/// Opening a gate leaves the sides as they were.
TEST(Walls, OpeningKeepsTheSides) {
  Scene scene = scene_2d();
  scene.grid.walls[2][0] = friction(0.5);
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.gates = {{"gate", 0, 2.0, 0.5}};
  Fixture<2> fixture(scene);
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(fixture.resisted(node(1, 0), {3.0, -2.0}), (Vec<2>{3.0 * (1.0 - 1.0 / 3.0), 0.0}));
    EXPECT_EQ(fixture.constrained(node(0, 1), {1.0, -2.0}), (Vec<2>{0.0, -2.0}));
    fixture.walls.open_gates(0.5);
  }
}

TEST(Walls, Gates3d) {
  for (int axis = 0; axis < 3; ++axis) {
    Scene scene = scene_3d();
    scene.gates = {{"gate", axis, 1.0, 0.5}};
    const Fixture<3> fixture(scene);
    for (int k = 0; k <= 3; ++k)
      for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 4; ++i) {
          Vec<3> expected = {1.0, -2.0, 3.0};
          if (std::array{i, j, k}[static_cast<std::size_t>(axis)] == 1)
            expected[static_cast<std::size_t>(axis)] = 0.0;
          EXPECT_EQ(fixture.constrained(node(i, j, k), {1.0, -2.0, 3.0}), expected);
        }
  }
}

/// A block flies at a gate: it is held until the release, to the bit, and flies on after it.
TEST(Gates, HoldAMovingBlock) {
  Scene scene;
  scene.grid = grid_2d(0.1, {0.0, 0.0}, {1.0, 0.3});
  scene.materials = {elastic("rubber", 1000.0, 1e5, 0.0)};
  scene.regions = {box("block", "rubber", {0.2, 0.1}, {0.5, 0.2}, {1.0, 0.0, 0.0})};
  scene.gravity = {0.0, 0.0, 0.0};
  scene.gates = {{"gate", 0, 0.5, 0.015}};
  const auto simulation = make_simulation(scene);
  run_until(*simulation, 0.015);
  EXPECT_EQ(simulation->time(), 0.015);
  EXPECT_LT(simulation->front(), 0.5);
  run_until(*simulation, 0.25);
  EXPECT_GT(simulation->front(), 0.5) << "it is free again";
}

/// With steps of at most 0.01 s a release at 0.025 s is met by 0.01 + 0.0075 + 0.0075.
TEST(Gates, StepsEndAtTheRelease) {
  Scene scene;
  scene.grid = grid_2d(1.0, {0.0, 0.0}, {4.0, 3.0});
  scene.materials = {elastic("stone", 1000.0, 1e3, 0.0)}; // 1 m/s: the critical step is 1 s
  scene.regions = {box("block", "stone", {1.0, 1.0}, {2.0, 2.0})};
  scene.gravity = {0.0, 0.0, 0.0};
  scene.timing.max_time_step = 0.01;
  scene.gates = {{"gate", 0, 3.0, 0.025}};
  const auto simulation = make_simulation(scene);
  EXPECT_EQ(simulation->step(1.0), 0.01);
  EXPECT_NEAR(simulation->step(1.0), 0.0075, 1e-15);
  EXPECT_NEAR(simulation->step(1.0), 0.0075, 1e-15);
  EXPECT_EQ(simulation->time(), 0.025);
  EXPECT_EQ(simulation->step(1.0), 0.01) << "and then the full step again";
  EXPECT_NEAR(simulation->step(0.036), 0.001, 1e-15);
  EXPECT_EQ(simulation->time(), 0.036);
}
