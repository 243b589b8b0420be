// What happens on the nodes: gather the cells' tiles, advance the momentum, apply the walls.
#pragma once

#include "core/state.hpp"
#include "core/walls.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace scarp {

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
    const Real inv_m = node.m > 0.0 ? 1.0 / node.m : 0.0;
    for (std::size_t i = 0; i < Dim; ++i) node.v[i] = node.mv[i] * inv_m;
    walls.constrain(at.index, node.v);
    walls.hold_back(at.index, node.v); // as the remap does: position and strain see one velocity
  });
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
    Vec<Dim> drag = {};
    if (damping > 0.0)
      for (std::size_t i = 0; i < Dim; ++i)
        if (node.v[i] != 0.0) drag[i] = -damping * std::copysign(node.f[i], node.v[i]);
    const Real dt_over_m = node.m > 0.0 ? dt / node.m : 0.0;
    const Vec<Dim> before = node.v;
    for (std::size_t i = 0; i < Dim; ++i) node.v[i] += dt_over_m * (node.f[i] + drag[i]);
    walls.constrain(at.index, node.v);
    node.rubbed = 0.0;
    if (walls.have_friction()) {
      const Vec<Dim> free = node.v;
      walls.resist(at.index, node.v);
      for (std::size_t i = 0; i < Dim; ++i)
        node.rubbed += node.m * (free[i] - node.v[i]) * node.v[i];
    }
    // Forces work on the velocity that the points move with.
    node.damped = 0.0;
    for (std::size_t i = 0; i < Dim; ++i) node.damped -= dt * drag[i] * node.v[i];
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
    const Real inv_m = node.m > 0.0 ? 1.0 / node.m : 0.0;
    for (std::size_t i = 0; i < Dim; ++i) node.v[i] = node.mv[i] * inv_m;
    walls.constrain(at.index, node.v);
    walls.hold_back(at.index, node.v);
  });
}

} // namespace scarp
