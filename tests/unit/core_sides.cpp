// B-splines at the sides of the grid: images of nodes, the step's bound, friction.
#include "core/compiled_passes.hpp"
#include "core/contact_pass.hpp"
#include "core/lattice.hpp"
#include "core/time_step.hpp"
#include "tests/support/nodes.hpp"
#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr double h = 0.5;
const Material rock = elastic("rock", 1000.0, 1e6, 0.3);

/// A block that fills its grid of 0.5 m cells, or the lower part of it.
template <int Dim> Scene block(std::array<int, 3> cells, int filled) {
  Scene scene;
  const auto m = [](int n) { return h * n; };
  scene.grid = Dim == 2 ? grid_2d(h, {0.0, 0.0}, {m(cells[0]), m(cells[2])})
                        : grid_3d(h, {0.0, 0.0, 0.0}, {m(cells[0]), m(cells[1]), m(cells[2])});
  scene.materials = {rock};
  scene.regions = {
      box("rock", "rock", {0.0, 0.0}, {m(cells[0]), m(filled)}, {}, {0.0, m(cells[1])})};
  return scene;
}

template <int Dim> struct Body {
  State<Dim, SplineShape<Dim>> state;
  Walls<Dim> walls;
  Random random{31};

  explicit Body(const Scene& scene)
      : state(scene.grid, fill_regions<Dim>(scene)), walls(scene, state.grid) {}

  void gather_momenta() {
    state.order.update(state.particles);
    touch_all(state);
    scatter_pass<Dim, Terms::mass_momentum>(state);
    gather_momentum_pass(state, walls);
  }

  void move_at_random() {
    for (Column& v : state.particles.v)
      for (Real& value : v) value = random.between(-1.0, 1.0);
  }
};

/// Where the node is that a node is an image of, and by component whether an odd number of mirrors
/// lies between them.
template <int Dim> struct Source {
  int node;
  std::array<double, Dim> sign;
};
template <int Dim> Source<Dim> source(const GridIndex<Dim>& grid, const Scene& scene, int node) {
  Source<Dim> source = {node, {}};
  source.sign.fill(1.0);
  for (int a = 0; a < Dim; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const int along = grid.node_along(node, axis);
    for (const int side : {0, 1}) {
      const WallKind kind =
          scene.grid.walls[scene_axis<Dim>(a)][static_cast<std::size_t>(side)].kind;
      const bool outside = along == (side == 0 ? 0 : grid.nodes[axis] - 1);
      if (!outside || (kind != WallKind::fixed && kind != WallKind::symmetry)) continue;
      source.node += (side == 0 ? 1 : -1) * grid.node_stride[axis];
      for (std::size_t i = 0; i < Dim; ++i)
        if (kind == WallKind::fixed || i == axis) source.sign[i] *= -1.0;
    }
  }
  return source;
}

/// Every node has the velocity that its group of images has together.
template <int Dim> void expect_images_move_together(const Scene& scene) {
  Body<Dim> body(scene);
  body.move_at_random();
  // What the nodes have apart: the same scene without sides.
  Scene open = scene;
  for (auto& sides : open.grid.walls) sides = {};
  Body<Dim> apart(open);
  apart.state.particles.v = body.state.particles.v;
  body.gather_momenta();
  apart.gather_momenta();

  std::map<int, double> mass;
  std::map<int, Vec<Dim>> momentum;
  const auto& own = apart.state.nodal.nodes;
  for (const int node : active_nodes(apart.state)) {
    const auto at = static_cast<std::size_t>(node);
    const auto [of, sign] = source<Dim>(body.state.grid, scene, node);
    mass[of] += own.m[at];
    for (std::size_t i = 0; i < Dim; ++i) momentum[of][i] += sign[i] * own.m[at] * own.v[i][at];
  }
  for (const int node : active_nodes(body.state)) {
    const auto at = static_cast<std::size_t>(node);
    const auto [of, sign] = source<Dim>(body.state.grid, scene, node);
    EXPECT_EQ(body.state.nodal.nodes.m[at], own.m[at]);
    for (std::size_t i = 0; i < Dim; ++i)
      EXPECT_NEAR(body.state.nodal.nodes.v[i][at], sign[i] * momentum[of][i] / mass[of], 1e-13)
          << node << ' ' << i;
  }
}

/// The largest eigenvalue of M^-1 K over its bound, by the power method with the solver's passes.
double largest_eigenvalue(Body<2>& body) {
  constexpr double small = 1e-6; // so that the rotation of stress does nothing
  auto& state = body.state;
  auto& nodes = state.nodal.nodes;
  const auto moduli = ElasticModuli::from(rock.youngs_modulus, rock.poissons_ratio);
  body.move_at_random();
  body.gather_momenta();
  const auto square = [&] { // kinetic energy x 2
    double sum = 0.0;
    for (const int node : active_nodes(state))
      for (const Column& v : nodes.v)
        sum += nodes.m[static_cast<std::size_t>(node)] * v[static_cast<std::size_t>(node)] *
               v[static_cast<std::size_t>(node)];
    return sum;
  };
  double eigenvalue = 0.0;
  for (int round = 0; round < 300; ++round) {
    const double scale = 1.0 / std::sqrt(square());
    for (const int node : active_nodes(state))
      for (Column& v : nodes.v) v[static_cast<std::size_t>(node)] *= scale;
    for (Column& component : state.particles.tau) std::ranges::fill(component, 0.0);
    stress_pass<2>(state, 0, moduli, ElasticUpdate{}, false, small);
    for (Column& v : nodes.v) std::ranges::fill(v, 0.0);
    scatter_pass<2, Terms::force>(state);
    advance_momentum_pass(state, body.walls, {}, 0.0, 1.0 / small);
    eigenvalue = std::sqrt(square()); // of a unit vector
  }
  const double bound =
      2.0 / h * critical_speed<2, SplineShape<2>>(moduli, rock.density, state.half_point);
  return eigenvalue / (bound * bound);
}

} // namespace

TEST(Sides, ImagesMoveTogether2d) {
  for (const auto left : {WallKind::fixed, WallKind::symmetry, WallKind::free})
    for (const auto base : {WallKind::fixed, WallKind::symmetry}) {
      Scene scene = block<2>({3, 1, 4}, 2);
      scene.grid.walls[0] = {Wall{left}, Wall{WallKind::symmetry}};
      scene.grid.walls[2][0] = {base};
      expect_images_move_together<2>(scene);
    }
}

/// The node in the middle of the only cell then has images on both sides.
TEST(Sides, ImagesMoveTogetherInOneCell) {
  Scene scene = block<2>({1, 1, 3}, 2);
  scene.grid.walls[0] = {Wall{WallKind::symmetry}, Wall{WallKind::symmetry}};
  scene.grid.walls[2][0] = {WallKind::fixed};
  expect_images_move_together<2>(scene);
}

TEST(Sides, ImagesMoveTogether3d) {
  Scene scene = block<3>({2, 2, 3}, 3);
  scene.grid.walls[0] = {Wall{WallKind::symmetry}, Wall{WallKind::fixed}};
  scene.grid.walls[1] = {Wall{WallKind::symmetry}, Wall{WallKind::free}};
  scene.grid.walls[2] = {Wall{WallKind::fixed}, Wall{WallKind::symmetry}};
  expect_images_move_together<3>(scene);
}

/// Points that fill a block and move with v = a x (x from the side): control points have the
/// velocity of their place, with and without the points' gradients.  Without images that next to
/// the side would be half as fast again.
TEST(Sides, UniformStrainIsKept) {
  constexpr double a = 3.0;
  for (const bool affine : {false, true}) {
    Scene scene = block<2>({8, 1, 8}, 8);
    scene.grid.points_per_cell = 8;
    scene.grid.walls[0][0] = {WallKind::fixed};
    Body<2> body(scene);
    Particles<2>& points = body.state.particles;
    if (affine)
      for (Column& column : points.C) column.assign(points.rows(), 0.0);
    for (const std::size_t p : rows_of(points)) {
      points.v[0][p] = a * points.x[0][p];
      if (affine) points.C[0][p] = a;
    }
    body.gather_momenta();
    const Column& v = body.state.nodal.nodes.v[0];
    const auto row = static_cast<std::size_t>(4 * body.state.grid.node_stride[1]);
    for (std::size_t k = 0; k < 5; ++k)
      // 8 points a cell integrate the quadratic functions to 1/(24 64).
      EXPECT_NEAR(v[row + k], (static_cast<double>(k) - 0.5) * a * h, 5e-3 * a * h) << affine << k;
  }
}

/// One point, anywhere, at any kind of side; and the same for points that fill the grid.
TEST(Sides, TheStepsBoundHoldsBesideThem) {
  Random random(5);
  double most = 0.0;
  for (const auto left : {WallKind::free, WallKind::fixed, WallKind::symmetry})
    for (const auto base : {WallKind::free, WallKind::fixed, WallKind::symmetry})
      for (int draw = 0; draw < 12; ++draw) {
        Scene scene = block<2>({3, 1, 3}, draw == 0 ? 3 : 1);
        scene.grid.points_per_cell = draw == 0 ? 2 : 1;
        if (draw > 0) scene.regions = {box("rock", "rock", {0.0, 0.0}, {h, h})};
        scene.grid.walls[0][0] = {left};
        scene.grid.walls[2][0] = {base};
        Body<2> body(scene);
        if (draw > 0) {
          const auto somewhere = [&] { return h * std::pow(10.0, random.between(-6.0, -1e-3)); };
          body.state.particles.x = {Column{somewhere()}, Column{somewhere()}};
        }
        const double found = largest_eigenvalue(body);
        EXPECT_LE(found, 1.0 + 1e-6) << static_cast<int>(left) << static_cast<int>(base) << draw;
        most = std::max(most, found);
      }
  EXPECT_GT(most, 0.5) << "the bound is not far from what there is";
}

/// The impulse of a friction side: the same for both nodes, and what Coulomb says of their mean.
TEST(Sides, FrictionPushesBothNodesOfAPair) {
  Scene scene = block<2>({4, 1, 4}, 2);
  scene.grid.walls[2][0] = {WallKind::friction, 0.3};
  scene.grid.walls[0][0] = {WallKind::symmetry};
  Body<2> body(scene);
  body.move_at_random();
  for (Real& v : body.state.particles.v[1]) v -= 0.5; // downwards, most of them
  body.state.order.update(body.state.particles);
  touch_all(body.state);
  scatter_pass<2, Terms::all>(body.state);
  // As it would be without the side.
  Scene open = scene;
  open.grid.walls[2][0] = {WallKind::free};
  const Walls<2> no_side(open, body.state.grid);
  gather_momentum_pass(body.state, no_side);
  advance_momentum_pass(body.state, no_side, {}, 0.0, 1e-3);
  const auto before = body.state.nodal.nodes;
  forget_rubs(body.state, body.walls);
  const Real taken = resist_pass(body.state, body.walls);
  const auto& after = body.state.nodal.nodes;

  const auto& side = body.walls.friction().front();
  const auto& pairs = body.state.order.side_pairs(side.axis, side.side);
  EXPECT_EQ(pairs.size(), 6U);
  std::size_t pushed = 0;
  for (const auto& [outer, inner] : pairs) {
    const auto o = static_cast<std::size_t>(outer), i = static_cast<std::size_t>(inner);
    Vec<2> mean, mean_after;
    for (std::size_t k = 0; k < 2; ++k) {
      mean[k] = 0.5 * (before.v[k][o] + before.v[k][i]);
      mean_after[k] = 0.5 * (after.v[k][o] + after.v[k][i]);
      const double impulse = (after.v[k][o] - before.v[k][o]) / before.inv_m[o];
      EXPECT_NEAR(impulse, (after.v[k][i] - before.v[k][i]) / before.inv_m[i],
                  1e-12 * std::abs(impulse));
      EXPECT_NEAR(after.dv[k][o] - before.dv[k][o], after.v[k][o] - before.v[k][o], 1e-15);
    }
    const Vec<2> expected = side.resist(mean);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(mean_after[k], expected[k], 1e-14);
    pushed += mean_after != mean ? 1U : 0U;
  }
  EXPECT_GE(pushed, 4U);
  EXPECT_GT(taken, 0.0);
}

/// A friction side beside one with images, on a body that comes off it and is pressed against it:
/// what it does to the images is the image of what it does to the body.
TEST(Sides, FrictionKeepsImages) {
  for (const auto base : {WallKind::fixed, WallKind::symmetry})
    for (const auto side : {0U, 1U}) {
      Scene scene = block<2>({3, 1, 4}, 2);
      scene.grid.walls[0][side] = {WallKind::friction, 0.4};
      scene.grid.walls[2][0] = {base};
      Body<2> body(scene);
      body.move_at_random();
      const auto expect_images = [&] {
        for (const int node : active_nodes(body.state)) {
          const auto [of, sign] = source<2>(body.state.grid, scene, node);
          for (std::size_t i = 0; i < 2; ++i)
            EXPECT_DOUBLE_EQ(body.state.nodal.nodes.v[i][static_cast<std::size_t>(node)],
                             sign[i] * body.state.nodal.nodes.v[i][static_cast<std::size_t>(of)])
                << node << ' ' << i;
        }
      };
      body.gather_momenta();
      expect_images();
      scatter_pass<2, Terms::force>(body.state);
      advance_momentum_pass(body.state, body.walls, {3.0, -5.0}, 0.0, 0.1);
      expect_images();
    }
}

/// A side that has pressed in a step gives nothing back in the remap: its pairs do not move away
/// from it, which its force would do work on.
TEST(Sides, WhatHasPressedIsHeldInTheRemap) {
  Scene scene = block<2>({4, 1, 4}, 2);
  scene.grid.walls[2][0] = {WallKind::friction, 0.3};
  Body<2> body(scene);
  // It slides, so that nothing sticks; its foot moves down and its head up, which the remap would
  // give the pairs a part of.
  for (std::size_t p = 0; p < body.state.particles.rows(); ++p) {
    body.state.particles.v[0][p] = 10.0;
    body.state.particles.v[1][p] = 4.0 * (body.state.particles.x[1][p] - 0.3);
  }
  body.gather_momenta();
  scatter_pass<2, Terms::force>(body.state);
  advance_momentum_pass(body.state, body.walls, {0.0, -5.0}, 0.0, 0.1);
  gather_pass<2, true>(body.state, 0.0);
  remap_velocity_pass(body.state, body.walls, 0.1);
  const auto& rubs = body.state.nodal.rubs[1][0];
  const auto& pairs = body.state.contacts[1][0];
  const Column& v = body.state.nodal.nodes.v[1];
  std::size_t pressed = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Real mean = 0.5 * (v[static_cast<std::size_t>(pairs[k].outer)] +
                             v[static_cast<std::size_t>(pairs[k].inner)]);
    EXPECT_GE(mean, -1e-14);
    if (!rubs[k].pressed) continue;
    ++pressed;
    EXPECT_LE(mean, 1e-14);
  }
  EXPECT_GE(pressed, 2U);
}

/// In a corner of two friction sides neither's friction pushes through the other.
TEST(Sides, FrictionOfOneDoesNotPushThroughTheOther) {
  Scene scene = block<2>({4, 1, 4}, 2);
  scene.grid.walls[0][0] = {WallKind::friction, 0.9};
  scene.grid.walls[2][0] = {WallKind::friction, 0.9};
  Body<2> body(scene);
  body.move_at_random();
  body.gather_momenta();
  scatter_pass<2, Terms::force>(body.state);
  advance_momentum_pass(body.state, body.walls, {-5.0, -5.0}, 0.0, 0.1);
  for (const std::size_t axis : {0U, 1U}) {
    const Column& v = body.state.nodal.nodes.v[axis];
    for (const auto& [outer, inner] : body.state.order.side_pairs(axis, 0))
      EXPECT_GE(v[static_cast<std::size_t>(outer)] + v[static_cast<std::size_t>(inner)], -1e-14);
  }
}
