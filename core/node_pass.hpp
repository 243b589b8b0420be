// What happens on the nodes: add up the tiles' sums, advance the momentum, apply the walls.
#pragma once

#include "core/side_pass.hpp"
#include "core/state.hpp"
#include "core/walls.hpp"

#include <type_traits>
#include <utility>

namespace scarp {

/// Adds up the tiles' entries for the nodes of a run.
template <int Dim, class Shape>
[[gnu::always_inline]] inline Pack<typename Shape::Number>
add_up(const auto& run, const typename TileSums<Dim, Shape>::Lines& lines) {
  using T = typename Shape::Number;
  Pack<T> sum = T(0);
  for (std::size_t line = 0; line < lines.size(); ++line) {
    sum += load_lanes(&lines[line][run.whole[line]]);
    sum += load_first<Shape::width - 1>(&lines[line][run.ends[line]]);
  }
  return sum;
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

/// (m v)_I of a run from the tiles' sums; it is kept in v until the masses are known.
template <int Dim, class Shape> void add_up_momenta(State<Dim, Shape>& state, const auto& run) {
  for (std::size_t i = 0; i < Dim; ++i)
    store_lanes(add_up<Dim, Shape>(run, state.nodal.sums.mv[i]),
                &state.nodal.nodes.v[i][static_cast<std::size_t>(run.node)], run.count);
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
  const auto inv_m = load_lanes(&nodes.inv_m[first]);
  for (auto& v : nodes.v) store_lanes(inv_m * load_lanes(&v[first]), &v[first], run.count);
  constrain(nodes, walls, run);
}

/// m_I and (m v)_I, and v_I under the constraints.
template <int Dim, class Shape>
void gather_momentum_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  state.nodal.remapped = false;
  const auto add_up_masses = [&](const auto& run) __attribute__((always_inline)) {
    const auto first = static_cast<std::size_t>(run.node);
    const Pack<T> m = add_up<Dim, Shape>(run, state.nodal.sums.m);
    store_lanes(m, &nodes.m[first], run.count);
    store_lanes(m, &nodes.inv_m[first], run.count);
    if (state.nodal.tracks_fraction) {
      const Pack<T> V0 = add_up<Dim, Shape>(run, state.nodal.sums.V0);
      const auto& widths = state.nodal.widths;
      Pack<T> volume =
          load_lanes(&widths[0][static_cast<std::size_t>(state.grid.node_along(run.node, 0))]);
      for (std::size_t a = 1; a < Dim; ++a)
        volume *= widths[a][static_cast<std::size_t>(state.grid.node_along(run.node, a))];
      Pack<T> fraction = V0 / volume;
      where(!(volume > 0.0F && V0 > 0.0F), fraction) = 1.0F; // beyond the grid; such are full
      store_lanes(fraction, &nodes.fraction[first], run.count);
    }
    add_up_momenta(state, run);
  };
  sweep_nodes(
      state, walls, add_up_masses,
      [&] {
        add_images(state, walls, nodes.inv_m, [](const auto&) { return T(1); });
        add_images(state, walls, nodes.v);
      },
      [&](const auto& run, std::size_t) __attribute__((always_inline)) {
        T* at = &nodes.inv_m[static_cast<std::size_t>(run.node)];
        const Pack<T> m = load_lanes(at);
        Pack<T> inverse = 1.0F / m;
        where(!(m > 0.0F), inverse) = 0.0F;
        store_lanes(inverse, at, run.count);
        find_velocities(state, walls, run);
      });
  forget_rubs(state, walls);
  hold_back_pass(state, walls);
}

/// v_I += dt (f_int + m g + f_damping)_I / m_I; keeps the change in dv for the FLIP increment.
/// Local damping: each component of the unbalanced force loses the part `damping` of its size
/// against the motion (Cundall 1987).  What balances a force is also what friction sides answer to
/// it: a film that lies on one would else be damped by its whole weight, which throws it up.
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
  const auto force = [&](const auto& run) __attribute__((always_inline)) {
    const Pack<T> m = load_lanes(&nodes.m[static_cast<std::size_t>(run.node)]);
    std::array<Pack<T>, Dim> f;
    for (std::size_t i = 0; i < Dim; ++i)
      f[i] = add_up<Dim, Shape>(run, state.nodal.sums.f[i]) + m * number<T>(gravity[i]);
    return f;
  };
  const auto advance = [&](
      const auto& run, std::size_t number_of_run, const std::array<Pack<T>, Dim>& f,
      Real damped_part, const std::array<Pack<T>, Dim>& unbalanced) __attribute__((always_inline)) {
    const auto first = static_cast<std::size_t>(run.node);
    const Pack<T> inv_m = load_lanes(&nodes.inv_m[first]);
    std::array<Pack<T>, Dim> before, drag;
    for (std::size_t i = 0; i < Dim; ++i) {
      before[i] = load_lanes(&nodes.v[i][first]);
      drag[i] = 0.0F;
      if (damped_part > 0.0)
        where(before[i] != 0.0F, drag[i]) =
            number<T>(-damped_part) * std::experimental::copysign(unbalanced[i], before[i]);
      store_lanes(before[i] + number<T>(dt) * inv_m * (f[i] + drag[i]), &nodes.v[i][first],
                  run.count);
    }
    constrain(nodes, walls, run);
    for (std::size_t i = 0; i < Dim; ++i) {
      const Pack<T> v = load_lanes(&nodes.v[i][first]);
      store_lanes(v - before[i], &nodes.dv[i][first], run.count);
      if (damped_part == 0.0) continue;
      if (state.moves_with_strain) store_lanes(drag[i], &nodes.drag[i][first], run.count);
      // Of what moves together, each node counts for its part of the mass.
      for (std::size_t k = 0; k < run.count; ++k) {
        const Real impulse = -dt * drag[i][k];
        state.nodal.damped[number_of_run] +=
            nodes.m[first + k] * inv_m[k] *
            (state.moves_with_strain ? 0.5 * impulse * before[i][k]
                                     : taken_work(before[i][k], v[k], impulse));
      }
    }
  };
  const bool exchange = !walls.mirrors().empty();
  if (exchange) {
    for (auto& f : nodes.f) f.resize(nodes.m.size());
    for_each_node_run(state, [&](const auto& run, std::size_t) {
      const std::array<Pack<T>, Dim> f = force(run);
      for (std::size_t i = 0; i < Dim; ++i)
        store_lanes(f[i], &nodes.f[i][static_cast<std::size_t>(run.node)], run.count);
    });
    add_images(state, walls, nodes.f);
  }
  const auto exchanged = [&](const auto& run) __attribute__((always_inline)) {
    std::array<Pack<T>, Dim> f;
    for (std::size_t i = 0; i < Dim; ++i)
      f[i] = load_lanes(&nodes.f[i][static_cast<std::size_t>(run.node)]);
    return f;
  };
  const auto all_forces = [&](const auto& run) __attribute__((always_inline)) {
    return exchange ? exchanged(run) : force(run);
  };
  if (damping == 0.0 || walls.friction().empty()) {
    for_each_node_run(state, [&](const auto& run, std::size_t number_of_run) {
      const std::array<Pack<T>, Dim> f = all_forces(run);
      advance(run, number_of_run, f, damping, f);
    });
  } else {
    for_each_node_run(state, [&](const auto& run, std::size_t number_of_run) {
      const std::array<Pack<T>, Dim> f = all_forces(run);
      advance(run, number_of_run, f, 0.0, f);
    });
    resist_pass(state, walls);
    for_each_node_run(state, [&](const auto& run, std::size_t number_of_run) {
      const auto first = static_cast<std::size_t>(run.node);
      const Pack<T> inv_m = load_lanes(&nodes.inv_m[first]);
      std::array<Pack<T>, Dim> unbalanced;
      for (std::size_t i = 0; i < Dim; ++i) {
        const Pack<T> dv = load_lanes(&nodes.dv[i][first]);
        unbalanced[i] = 0.0F;
        where(inv_m > 0.0F, unbalanced[i]) = dv / (number<T>(dt) * inv_m);
        store_lanes(load_lanes(&nodes.v[i][first]) - dv, &nodes.v[i][first], run.count);
      }
      advance(run, number_of_run, all_forces(run), damping, unbalanced);
    });
  }
  state.nodal.rubbed = resist_pass(state, walls);
}

/// MUSL: v_I from the points' updated momenta; masses and weights are those of the first mapping.
/// The velocities before it are in dv then.
template <int Dim, class Shape>
void remap_velocity_pass(State<Dim, Shape>& state, const Walls<Dim>& walls, Real dt) {
  state.nodal.remapped = true;
  std::swap(state.nodal.nodes.v, state.nodal.nodes.dv);
  sweep_nodes(
      state, walls, [&](const auto& run) { add_up_momenta(state, run); },
      [&] { add_images(state, walls, state.nodal.nodes.v); },
      [&](const auto& run, std::size_t) { find_velocities(state, walls, run); });
  // In a corner of two friction sides each moves what the other holds; such turns go on to what
  // both hold.
  const int turns = walls.friction().size() > 1 ? 3 : 1;
  Real rubbed = 0.0;
  for (int turn = 0; turn < turns; ++turn) rubbed = hold_back_pass(state, walls);
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
