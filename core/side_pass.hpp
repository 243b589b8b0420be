// What the sides of the grid do to the nodes beside them: images and friction (core/walls.hpp).
#pragma once

#include "core/state.hpp"
#include "core/walls.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {

/// Calls visit(outer, inner, the pair's number) for the active nodes of a side, on all threads.  No
/// two pairs share a node.
template <int Dim, class Shape, class Visit>
void for_each_side_pair(const State<Dim, Shape>& state, const auto& side, Visit&& visit) {
  const auto& pairs = state.order.side_pairs(side.axis, side.side);
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

/// Calls push(pair's number, node, v, part) for the active nodes of a friction side: v, the
/// velocity on the side, is the mean of the pair's, and a change of it is one of `part` times as
/// much of the node's, since the impulse is the same for both.
template <int Dim, class Shape>
void for_each_push(const State<Dim, Shape>& state, const typename Walls<Dim>::Friction& side,
                   const auto& push) {
  const auto& nodes = state.nodal.nodes;
  const auto mass = [&](std::size_t node) -> Real {
    return nodes.inv_m[node] > 0 ? 1.0 / nodes.inv_m[node] : 0.0;
  };
  for_each_side_pair(state, side, [&](std::size_t outer, std::size_t inner, std::size_t k) {
    Vec<Dim> v;
    for (std::size_t i = 0; i < Dim; ++i) v[i] = 0.5 * (nodes.v[i][outer] + nodes.v[i][inner]);
    if (outer == inner) return push(k, outer, v, 1.0);
    const Real whole = mass(outer) + mass(inner);
    if (whole == 0.0) return;
    const Real of_outer = 2.0 * mass(inner) / whole;
    push(k, outer, v, of_outer);
    push(k, inner, v, 2.0 - of_outer);
  });
}

/// Stops the motion into friction sides.
template <int Dim, class Shape>
void hold_back_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  using T = typename Shape::Number;
  for (const auto& side : walls.friction())
    for_each_push(state, side, [&](std::size_t, std::size_t node, const Vec<Dim>& v, Real part) {
      const Vec<Dim> left = side.hold_back(v);
      for (std::size_t i = 0; i < Dim; ++i)
        state.nodal.nodes.v[i][node] += static_cast<T>(part * (left[i] - v[i]));
    });
}

/// The same with Coulomb's friction, in the step's change of velocity as well.  Returns what
/// friction takes, J, with the step's velocities.
template <int Dim, class Shape>
Real resist_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  Real taken = 0.0;
  for (const auto& side : walls.friction()) {
    auto& rubs = state.nodal.rubs[side.axis][side.side];
    rubs.assign(state.order.side_pairs(side.axis, side.side).size(), {});
    Column work(rubs.size(), 0.0); // by pair
    for_each_push(state, side, [&](std::size_t k, std::size_t node, const Vec<Dim>& v, Real part) {
      const Vec<Dim> left = side.resist(v), without_friction = side.hold_back(v);
      for (std::size_t i = 0; i < Dim; ++i) rubs[k].dv[i] = left[i] - without_friction[i];
      rubs[k].stuck = left == Vec<Dim>{} && left != v;
      for (std::size_t i = 0; i < Dim; ++i) {
        const Real before = nodes.v[i][node] - nodes.dv[i][node];
        const auto change = static_cast<T>(part * (left[i] - v[i]));
        nodes.v[i][node] += change;
        nodes.dv[i][node] += change;
        work[k] += taken_work(before, nodes.v[i][node],
                              nodes.m[node] * part * (without_friction[i] - left[i]));
      }
    });
    for (const Real of_pair : work) taken += of_pair;
  }
  return taken;
}

/// Keeps what has stuck to friction sides in this step there, when velocities are mapped again: a
/// wall that holds them in one mapping and lets them go in the other would drive them along.
/// Returns what friction takes, J, with the remapped velocities.
template <int Dim, class Shape> Real stick_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  Real taken = 0.0;
  for (const auto& side : walls.friction()) {
    const auto& rubs = state.nodal.rubs[side.axis][side.side];
    Column work(rubs.size(), 0.0); // by pair
    for_each_push(state, side, [&](std::size_t k, std::size_t node, const Vec<Dim>& v, Real part) {
      const Vec<Dim> left = rubs[k].stuck ? Vec<Dim>{} : side.hold_back(v);
      for (std::size_t i = 0; i < Dim; ++i) {
        nodes.v[i][node] += static_cast<T>(part * (left[i] - v[i]));
        work[k] -= nodes.m[node] * part * rubs[k].dv[i] * nodes.v[i][node];
      }
    });
    for (const Real of_pair : work) taken += of_pair;
  }
  return taken;
}

} // namespace scarp
