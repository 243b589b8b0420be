// What the sides of the grid do to the nodes beside them: images and friction (core/walls.hpp).
#pragma once

#include "core/state.hpp"
#include "core/walls.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {

/// The pairs of nodes that a side acts on in this step.
template <int Dim, class Shape>
const auto& acting_pairs(const State<Dim, Shape>& state, std::size_t axis, std::size_t side) {
  if constexpr (Shape::layout == NodeLayout::spline)
    return state.contacts[axis][side];
  else
    return state.order.side_pairs(axis, side);
}

/// Calls visit(outer, inner, the pair's number) for the nodes that a side acts on, on all threads.
/// No two pairs share a node.
template <int Dim, class Shape, class Visit>
void for_each_side_pair(const State<Dim, Shape>& state, const auto& side, Visit&& visit) {
  const auto& pairs = acting_pairs(state, side.axis, side.side);
  const auto n = static_cast<std::int64_t>(pairs.size());
#pragma omp parallel for schedule(static) if (n > 4096)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto [outer, inner] = pairs[static_cast<std::size_t>(k)];
    visit(static_cast<std::size_t>(outer), static_cast<std::size_t>(inner),
          static_cast<std::size_t>(k));
  }
}

/// Gives a node and its images the sum over all of them, each with its sign(mirror): what moves
/// together has the sum of the masses, and of the momenta and forces along its motion.
template <int Dim, class Shape>
void add_images(const State<Dim, Shape>& state, const Walls<Dim>& walls,
                ColumnOf<typename Shape::Number>& values, const auto& sign) {
  const auto& mirrors = walls.mirrors();
  for (const auto& mirror : mirrors)
    for_each_side_pair(state, mirror, [&](std::size_t outer, std::size_t inner, std::size_t) {
      values[inner] += sign(mirror) * values[outer];
    });
  // From the last one on, so that a corner's images get what their own images have got.
  for (auto mirror = mirrors.rbegin(); mirror != mirrors.rend(); ++mirror)
    for_each_side_pair(state, *mirror, [&](std::size_t outer, std::size_t inner, std::size_t) {
      values[outer] = sign(*mirror) * values[inner];
    });
}

/// Of vectors, by component.
template <int Dim, class Shape>
void add_images(const State<Dim, Shape>& state, const Walls<Dim>& walls, auto& vectors) {
  for (std::size_t i = 0; i < Dim; ++i)
    add_images(state, walls, vectors[i], [i](const auto& mirror) {
      return static_cast<typename Shape::Number>(mirror.sign(i));
    });
}

/// J, that an impulse against the motion (N s) takes: with the mean of the velocities before and
/// after the step, as far as that is of the order of the one before.  What an impulse changes on a
/// node of little mass its points hardly see.
inline Real taken_work(Real before, Real after, Real impulse) {
  const Real most = std::abs(before);
  return impulse * (before + std::clamp(0.5 * (after - before), -most, most));
}

/// Begins a step, whose pairs are other ones than those before: nothing has rubbed yet.
template <int Dim, class Shape>
void forget_rubs(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  for (const auto& side : walls.friction())
    state.nodal.rubs[side.axis][side.side].assign(acting_pairs(state, side.axis, side.side).size(),
                                                  {});
}

/// The sign of a node's velocity, by component, to that of the node inside that it is an image of.
template <int Dim, class Shape>
Vec<Dim> image_sign(const State<Dim, Shape>& state, const Walls<Dim>& walls, int node) {
  Vec<Dim> sign;
  sign.fill(1.0);
  for (const auto& mirror : walls.mirrors()) {
    const int along = state.grid.node_along(node, mirror.axis);
    if (along != (mirror.side == 0 ? 0 : state.grid.nodes[mirror.axis] - 1)) continue;
    const auto& pairs = acting_pairs(state, mirror.axis, mirror.side);
    if (!std::ranges::binary_search(pairs, node, {}, [](const auto& pair) { return pair.outer; }))
      continue;
    for (std::size_t i = 0; i < Dim; ++i) sign[i] *= mirror.sign(i);
  }
  return sign;
}

/// Gives the velocity on friction sides, the mean of a pair's, the value left(side, rub, v), by an
/// impulse that is the same for both nodes; images of a pair get the image of that, else a side
/// would act on a body and its image at another side as if they moved apart, and push it through
/// that side.  give(rub, node, i, change, impulse) is to change a component of a node's velocity
/// and to add to rub.taken what friction's impulse of that (N s) takes.  Returns the sum, J.
template <int Dim, class Shape>
Real push_pairs(State<Dim, Shape>& state, const Walls<Dim>& walls, const auto& left,
                const auto& give) {
  using T = typename Shape::Number;
  const Nodes<Dim, T>& nodes = state.nodal.nodes;
  const auto mass = [&](std::size_t node) -> Real {
    return nodes.inv_m[node] > 0 ? 1.0 / nodes.inv_m[node] : 0.0;
  };
  Real taken = 0.0;
  for (const auto& side : walls.friction()) {
    auto& rubs = state.nodal.rubs[side.axis][side.side];
    for_each_side_pair(state, side, [&](std::size_t outer, std::size_t inner, std::size_t k) {
      Vec<Dim> v;
      for (std::size_t i = 0; i < Dim; ++i) v[i] = 0.5 * (nodes.v[i][outer] + nodes.v[i][inner]);
      auto& rub = rubs[k];
      rub.taken = 0.0;
      const Vec<Dim> sign = image_sign(state, walls, static_cast<int>(outer));
      for (std::size_t i = 0; i < Dim; ++i) v[i] *= sign[i];
      const Vec<Dim> after = left(side, rub, v);
      // A change of the mean is one of `part` times as much of the node's.
      const auto push = [&](std::size_t node, Real part) {
        for (std::size_t i = 0; i < Dim; ++i)
          give(rub, node, i, static_cast<T>(sign[i] * part * (after[i] - v[i])),
               sign[i] * nodes.m[node] * part * rub.dv[i]);
      };
      if (outer == inner) return push(outer, 1.0);
      const Real whole = mass(outer) + mass(inner);
      if (whole == 0.0) return;
      const Real of_outer = 2.0 * mass(inner) / whole;
      push(outer, of_outer);
      push(inner, 2.0 - of_outer);
    });
    for (const auto& rub : rubs) taken += rub.taken;
  }
  return taken;
}

/// Stops the motion into friction sides.  What one takes is a component that no other takes, while
/// friction takes all others': so this comes last, else friction on one side of a corner would push
/// points through the other.
template <int Dim, class Shape>
void stop_at_sides(State<Dim, Shape>& state, const Walls<Dim>& walls, const auto& change) {
  if (walls.friction().size() < 2) return;
  push_pairs(
      state, walls, [](const auto& side, auto&, const Vec<Dim>& v) { return side.hold_back(v); },
      [&](auto&, std::size_t node, std::size_t i, auto by, Real) { change(node, i, by); });
}

/// Stops the motion into friction sides; and, in a step in which one has pressed, away from it, and
/// all motion on it where Coulomb's friction has stopped it: a side that holds velocities in one
/// mapping and lets them go when they are mapped again would drive them, by its force times what it
/// lets go.  Returns what friction takes, J, with the velocities after it.
template <int Dim, class Shape>
Real hold_back_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  auto& nodes = state.nodal.nodes;
  const auto change = [&](std::size_t node, std::size_t i, auto by) { nodes.v[i][node] += by; };
  const Real taken = push_pairs(
      state, walls,
      [](const auto& side, const auto& rub, const Vec<Dim>& v) {
        if (rub.stuck) return Vec<Dim>{};
        Vec<Dim> after = side.hold_back(v);
        if (rub.pressed) after[side.axis] = 0.0;
        return after;
      },
      [&](auto& rub, std::size_t node, std::size_t i, auto by, Real impulse) {
        change(node, i, by);
        rub.taken -= impulse * nodes.v[i][node];
      });
  stop_at_sides(state, walls, change);
  return taken;
}

/// Stops the motion into friction sides with Coulomb's friction, in the step's change of velocity
/// as well.  Returns what friction takes, J, with the step's velocities.
template <int Dim, class Shape>
Real resist_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  auto& nodes = state.nodal.nodes;
  const auto change = [&](std::size_t node, std::size_t i, auto by) {
    nodes.v[i][node] += by;
    nodes.dv[i][node] += by;
  };
  const Real taken = push_pairs(
      state, walls,
      [](const auto& side, auto& rub, const Vec<Dim>& v) {
        const Vec<Dim> left = side.resist(v), without_friction = side.hold_back(v);
        for (std::size_t i = 0; i < Dim; ++i) rub.dv[i] = left[i] - without_friction[i];
        rub.stuck = left == Vec<Dim>{} && left != v;
        rub.pressed = left[side.axis] != v[side.axis];
        return left;
      },
      [&](auto& rub, std::size_t node, std::size_t i, auto by, Real impulse) {
        const Real before = nodes.v[i][node] - nodes.dv[i][node];
        change(node, i, by);
        rub.taken += taken_work(before, nodes.v[i][node], -impulse);
      });
  stop_at_sides(state, walls, change);
  return taken;
}

} // namespace scarp
