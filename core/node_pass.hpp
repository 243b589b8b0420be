// What happens on the nodes: add up the strips' sums, advance the momentum, apply the walls.
#pragma once

#include "core/side_pass.hpp"
#include "core/state.hpp"
#include "core/walls.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace scarp {

/// One number for each node of a run.
template <class T> using RunValuesOf = std::array<T, CellOrder<2>::NodeRun::most>;

/// Adds up the lines of the strips that reach the nodes of a run.
template <int Dim, class Shape>
[[gnu::always_inline]] inline void add_up(const State<Dim, Shape>& state, const auto& run,
                                          const typename StripSums<Dim, Shape>::Lines& lines,
                                          RunValuesOf<typename Shape::Number>& sum) {
  for (std::size_t k = run.first_part; k < run.end_part; ++k) {
    const auto& part = state.order.part(k);
    const auto* from = &lines[part.line][part.entry];
    auto* to = &sum[static_cast<std::size_t>(part.node - run.node)];
    for (std::size_t n = 0; n < part.count; ++n) to[n] += from[n];
  }
}

/// A sweep over the runs of active nodes in two halves: between them the nodes outside mirrors and
/// those inside exchange what the first half has put into `exchange`.  Without mirrors it is one.
template <int Dim, class Shape>
void sweep_nodes(State<Dim, Shape>& state, const Walls<Dim>& walls, auto&& first, auto&& exchange,
                 auto&& second) {
  const bool at_once = walls.mirrors().empty();
  for_each_node_run(state, [&](const auto& run, std::size_t number) {
    first(run);
    if (at_once) second(run, number);
  });
  if (at_once) return;
  exchange();
  for_each_node_run(state, second);
}

/// (m v)_I of a run from the strips' sums; it is kept in v until the masses are known.
template <int Dim, class Shape> void add_up_momenta(State<Dim, Shape>& state, const auto& run) {
  using T = typename Shape::Number;
  for (std::size_t i = 0; i < Dim; ++i) {
    RunValuesOf<T> mv = {};
    add_up(state, run, state.nodal.sums.mv[i], mv);
    std::copy_n(mv.begin(), run.count, &state.nodal.nodes.v[i][static_cast<std::size_t>(run.node)]);
  }
}

/// Takes the constrained components of a run's velocities away, as in every mapping, since position
/// and strain see one velocity.
template <int Dim, class T>
void constrain(Nodes<Dim, T>& nodes, const Walls<Dim>& walls, const auto& run) {
  if (!walls.hold(run.node, run.count)) return;
  for (std::size_t k = 0; k < run.count; ++k) {
    const auto at = static_cast<std::size_t>(run.node) + k;
    Vec<Dim> v;
    for (std::size_t i = 0; i < Dim; ++i) v[i] = nodes.v[i][at];
    walls.constrain(static_cast<int>(at), v);
    for (std::size_t i = 0; i < Dim; ++i) nodes.v[i][at] = static_cast<T>(v[i]);
  }
}

/// v_I = (m v)_I / m_I, under the constraints.
template <int Dim, class Shape>
void find_velocities(State<Dim, Shape>& state, const Walls<Dim>& walls, const auto& run) {
  auto& nodes = state.nodal.nodes;
  const auto first = static_cast<std::size_t>(run.node);
  for (std::size_t i = 0; i < Dim; ++i) {
    const auto* inv_m = &nodes.inv_m[first];
    auto* v = &nodes.v[i][first];
    for (std::size_t k = 0; k < run.count; ++k) v[k] *= inv_m[k];
  }
  constrain(nodes, walls, run);
}

/// m_I and (m v)_I, and v_I under the constraints.
template <int Dim, class Shape>
void gather_momentum_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  const auto add_up_masses = [&](const auto& run) {
    const auto first = static_cast<std::size_t>(run.node);
    RunValuesOf<T> m = {};
    add_up(state, run, state.nodal.sums.m, m);
    for (std::size_t k = 0; k < run.count; ++k) nodes.inv_m[first + k] = nodes.m[first + k] = m[k];
    if (state.nodal.tracks_fraction) {
      RunValuesOf<T> V0 = {};
      add_up(state, run, state.nodal.sums.V0, V0);
      for (std::size_t k = 0; k < run.count; ++k) {
        const Real volume = state.nodal.volume[first + k]; // 0: beyond the grid; such are full
        nodes.fraction[first + k] =
            static_cast<T>(volume > 0.0 && V0[k] > 0 ? V0[k] / volume : 1.0);
      }
    }
    add_up_momenta(state, run);
  };
  sweep_nodes(
      state, walls, add_up_masses,
      [&] {
        add_images(state, walls, nodes.inv_m, [](const auto&) { return T(1); });
        add_images(state, walls, nodes.v);
      },
      [&](const auto& run, std::size_t) {
        T* inv_m = &nodes.inv_m[static_cast<std::size_t>(run.node)];
        for (std::size_t k = 0; k < run.count; ++k) {
          const T inverse = T(1) / inv_m[k];
          inv_m[k] = inv_m[k] > 0 ? inverse : T(0);
        }
        find_velocities(state, walls, run);
      });
  forget_rubs(state, walls);
  hold_back_pass(state, walls);
}

/// v_I += dt (f_int + m g + f_damping)_I / m_I; keeps the change in dv for the FLIP increment.
/// Local damping: each component of the unbalanced force loses the part `damping` of its size
/// against the motion (Cundall 1987).
/// What damping and friction take is their force times the velocity that points and strain see:
/// mostly this one, or (State::moves_with_strain) the remapped one, in remap_velocity_pass.  Of
/// damping D it is the mean with the one before the step, v: D's sign is that of -v, and where it
/// turns the velocity round at every step, as it does at rest, it gives what it takes at the next
/// one: sum D/2 (|v_n| + v_n/|v_n| v_n+1) >= - D/2 |v_last|.
template <int Dim, class Shape>
void advance_momentum_pass(State<Dim, Shape>& state, const Walls<Dim>& walls,
                           const std::type_identity_t<Vec<Dim>>& gravity, Real damping, Real dt) {
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  state.nodal.damped.assign(state.order.node_runs().size(), 0.0);
  for (auto& drag : nodes.drag)
    drag.resize(damping > 0.0 && state.moves_with_strain ? nodes.m.size() : 0);
  const auto add_up_forces = [&](const auto& run) {
    const auto first = static_cast<std::size_t>(run.node);
    for (std::size_t i = 0; i < Dim; ++i) {
      RunValuesOf<T> force = {};
      add_up(state, run, state.nodal.sums.f[i], force);
      const auto b = static_cast<T>(gravity[i]);
      for (std::size_t k = 0; k < run.count; ++k)
        nodes.f[i][first + k] = force[k] + nodes.m[first + k] * b;
    }
  };
  const auto advance = [&](const auto& run, std::size_t number) {
    const auto first = static_cast<std::size_t>(run.node);
    const T* inv_m = &nodes.inv_m[first];
    std::array<RunValuesOf<T>, Dim> before, drag = {};
    for (std::size_t i = 0; i < Dim; ++i) {
      const T* f = &nodes.f[i][first];
      T* v = &nodes.v[i][first];
      std::copy_n(v, run.count, before[i].begin());
      if (damping > 0.0)
        for (std::size_t k = 0; k < run.count; ++k)
          drag[i][k] = v[k] != 0 ? static_cast<T>(-damping) * std::copysign(f[k], v[k]) : T(0);
      for (std::size_t k = 0; k < run.count; ++k)
        v[k] += static_cast<T>(dt) * inv_m[k] * (f[k] + drag[i][k]);
    }
    constrain(nodes, walls, run);
    for (std::size_t i = 0; i < Dim; ++i) {
      const T* v = &nodes.v[i][first];
      T* dv = &nodes.dv[i][first];
      for (std::size_t k = 0; k < run.count; ++k) dv[k] = v[k] - before[i][k];
      if (damping == 0.0) continue;
      if (state.moves_with_strain) std::copy_n(drag[i].begin(), run.count, &nodes.drag[i][first]);
      // Of what moves together, each node counts for its part of the mass.
      for (std::size_t k = 0; k < run.count; ++k) {
        const Real impulse = -dt * drag[i][k];
        state.nodal.damped[number] +=
            nodes.m[first + k] * inv_m[k] *
            (state.moves_with_strain ? 0.5 * impulse * before[i][k]
                                     : taken_work(before[i][k], v[k], impulse));
      }
    }
  };
  sweep_nodes(
      state, walls, add_up_forces, [&] { add_images(state, walls, nodes.f); }, advance);
  state.nodal.rubbed = resist_pass(state, walls);
}

/// MUSL: v_I from the points' updated momenta; masses and weights are those of the first mapping.
template <int Dim, class Shape>
void remap_velocity_pass(State<Dim, Shape>& state, const Walls<Dim>& walls, Real dt) {
  sweep_nodes(
      state, walls, [&](const auto& run) { add_up_momenta(state, run); },
      [&] { add_images(state, walls, state.nodal.nodes.v); },
      [&](const auto& run, std::size_t) { find_velocities(state, walls, run); });
  const Real rubbed = hold_back_pass(state, walls);
  if (!state.moves_with_strain) return;
  state.nodal.rubbed = rubbed;
  const Nodes<Dim, typename Shape::Number>& nodes = state.nodal.nodes;
  if (nodes.drag[0].empty()) return;
  for_each_node_run(state, [&](const auto& run, std::size_t number) {
    for (std::size_t n = static_cast<std::size_t>(run.node), end = n + run.count; n < end; ++n)
      for (std::size_t i = 0; i < Dim; ++i)
        state.nodal.damped[number] -=
            0.5 * nodes.m[n] * nodes.inv_m[n] * dt * nodes.drag[i][n] * nodes.v[i][n];
  });
}

} // namespace scarp
