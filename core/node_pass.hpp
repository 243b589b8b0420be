// What happens on the nodes: gather the cells' tiles, advance the momentum, apply the walls.
#pragma once

#include "core/state.hpp"
#include "core/walls.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace scarp {

/// 1/kg, of a control point next to a mirror (Walls::Mirror), by component.  With the image of odd
/// velocity, N_I v - N_image v, the lumped kinetic energy is (m_I + m_image) v^2 / 2; in the open
/// knot vector's functions that is the mass of the point and of the held one beside it.  Without it
/// the velocity of a uniform strain comes out half as large again next to the wall, and N falls to
/// 0 there while its gradient does not: no step would be short enough.
template <int Dim, class Shape>
Vec<Dim> mirrored_inverse_mass(const State<Dim, Shape>& state, const auto& at,
                               const typename Walls<Dim>::Mirror& mirror) {
  Vec<Dim> mass = {};
  for (std::size_t c = 0; c < at.slot.size(); ++c) {
    if (at.slot[c] < 0) continue;
    const auto& tile = state.nodal.tiles[static_cast<std::size_t>(at.slot[c])];
    const auto own = Shape::places(c);
    for (std::size_t d = 0; d < at.slot.size(); ++d) {
      const auto other = Shape::places(d);
      for (std::size_t i = 0; i < Dim; ++i) {
        bool moves = true;
        for (std::size_t a = 0; a < Dim; ++a)
          moves = moves &&
                  (other[a] == own[a] || (other[a] + 1 == own[a] && (mirror.lower[a] >> i & 1U)) ||
                   (other[a] == own[a] + 1 && (mirror.upper[a] >> i & 1U)));
        if (moves) mass[i] += tile.m[d];
      }
    }
  }
  for (Real& m : mass) m = m > 0.0 ? 1.0 / m : 0.0;
  return mass;
}

/// m_I and (m v)_I from the tiles, v_I = (m v)_I / m_I under the constraints (kept in v).
template <int Dim, class Shape>
void gather_momentum_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  for_each_node(state, [&](const auto& at) {
    NodeState<Dim>& node = state.nodal.nodes[static_cast<std::size_t>(at.index)];
    node.m = 0.0;
    Real V0 = 0.0;
    node.mv = {};
    for (std::size_t c = 0; c < at.slot.size(); ++c) {
      if (at.slot[c] < 0) continue;
      const auto& tile = state.nodal.tiles[static_cast<std::size_t>(at.slot[c])];
      node.m += tile.m[c];
      V0 += tile.V0[c];
      for (std::size_t i = 0; i < Dim; ++i) node.mv[i] += tile.mv[i][c];
    }
    if (state.nodal.tracks_fraction) {
      const Real volume = state.nodal.volume[static_cast<std::size_t>(at.index)];
      node.fraction = volume > 0.0 && V0 > 0.0 ? V0 / volume : 1.0; // nodes beyond the grid: full
    }
    node.inv_m.fill(node.m > 0.0 ? 1.0 / node.m : 0.0);
    if constexpr (Shape::layout == NodeLayout::spline)
      if (const auto* mirror = walls.mirror(at.index))
        node.inv_m = mirrored_inverse_mass(state, at, *mirror);
    for (std::size_t i = 0; i < Dim; ++i) node.v[i] = node.mv[i] * node.inv_m[i];
    walls.constrain(at.index, node.v);
    walls.hold_back(at.index, node.v); // as the remap does: position and strain see one velocity
  });
}

/// J, that an impulse against the motion (N s, by component) takes: with the mean of the velocities
/// before and after the step, as far as that is of the order of the one before.  What an impulse
/// changes on a node of little mass its points hardly see.
template <int Dim> Real taken_work(const Vec<Dim>& before, const Vec<Dim>& after, auto&& impulse) {
  Real work = 0.0;
  for (std::size_t i = 0; i < Dim; ++i) {
    const Real most = std::abs(before[i]);
    work += impulse(i) * (before[i] + std::clamp(0.5 * (after[i] - before[i]), -most, most));
  }
  return work;
}

/// v_I += dt (f_int + m g + f_damping)_I / m_I; keeps the change in dv for the FLIP increment.
/// Local damping: each component of the unbalanced force loses the part `damping` of its size
/// against the motion (Cundall 1987).
template <int Dim, class Shape>
void advance_momentum_pass(State<Dim, Shape>& state, const Walls<Dim>& walls,
                           const std::type_identity_t<Vec<Dim>>& gravity, Real damping, Real dt) {
  for_each_node(state, [&](const auto& at) {
    NodeState<Dim>& node = state.nodal.nodes[static_cast<std::size_t>(at.index)];
    for (std::size_t i = 0; i < Dim; ++i) node.f[i] = node.m * gravity[i];
    for (std::size_t c = 0; c < at.slot.size(); ++c) {
      if (at.slot[c] < 0) continue;
      const auto& tile = state.nodal.tiles[static_cast<std::size_t>(at.slot[c])];
      for (std::size_t i = 0; i < Dim; ++i) node.f[i] += tile.f[i][c];
    }
    const Vec<Dim> before = node.v;
    Vec<Dim> drag = {};
    if (damping > 0.0)
      for (std::size_t i = 0; i < Dim; ++i)
        if (before[i] != 0.0) drag[i] = -damping * std::copysign(node.f[i], before[i]);
    for (std::size_t i = 0; i < Dim; ++i) node.v[i] += dt * node.inv_m[i] * (node.f[i] + drag[i]);
    walls.constrain(at.index, node.v);
    node.rubbed = 0.0;
    if (walls.have_friction()) {
      Vec<Dim> free = node.v;
      walls.hold_back(at.index, free);
      walls.resist(at.index, node.v);
      node.rubbed = taken_work<Dim>(before, node.v,
                                    [&](std::size_t i) { return node.m * (free[i] - node.v[i]); });
    }
    node.damped = taken_work<Dim>(before, node.v, [&](std::size_t i) { return -dt * drag[i]; });
    for (std::size_t i = 0; i < Dim; ++i) node.dv[i] = node.v[i] - before[i];
  });
}

/// MUSL: v_I from the points' updated momenta; masses and weights are those of the first mapping.
template <int Dim, class Shape>
void remap_velocity_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  for_each_node(state, [&](const auto& at) {
    NodeState<Dim>& node = state.nodal.nodes[static_cast<std::size_t>(at.index)];
    node.mv = {};
    for (std::size_t c = 0; c < at.slot.size(); ++c) {
      if (at.slot[c] < 0) continue;
      const auto& tile = state.nodal.tiles[static_cast<std::size_t>(at.slot[c])];
      for (std::size_t i = 0; i < Dim; ++i) node.mv[i] += tile.mv[i][c];
    }
    for (std::size_t i = 0; i < Dim; ++i) node.v[i] = node.mv[i] * node.inv_m[i];
    walls.constrain(at.index, node.v);
    walls.hold_back(at.index, node.v);
  });
}

} // namespace scarp
