// What happens on the nodes: add up the strips' sums, advance the momentum, apply the walls.
#pragma once

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

/// Applies to the velocities of a run's nodes what acts on each alone.
template <int Dim, class T, class Apply>
void change_velocities(Nodes<Dim, T>& nodes, const auto& run, Apply&& apply) {
  for (std::size_t k = 0; k < run.count; ++k) {
    const int index = run.node + static_cast<int>(k);
    Vec<Dim> v;
    for (std::size_t i = 0; i < Dim; ++i) v[i] = nodes.v[i][static_cast<std::size_t>(index)];
    apply(index, v);
    for (std::size_t i = 0; i < Dim; ++i)
      nodes.v[i][static_cast<std::size_t>(index)] = static_cast<T>(v[i]);
  }
}

/// Takes constrained components away, and what friction sides do not let through: as in every
/// mapping, since position and strain see one velocity.
template <int Dim, class T>
void constrain(Nodes<Dim, T>& nodes, const Walls<Dim>& walls, const auto& run) {
  if (!walls.touch(run.node, run.count)) return;
  change_velocities(nodes, run, [&](int index, Vec<Dim>& v) {
    walls.constrain(index, v);
    walls.hold_back(index, v);
  });
}

/// (m v)_I from the strips' sums, v_I = (m v)_I / m_I.
template <int Dim, class Shape>
void find_velocities(State<Dim, Shape>& state, const auto& run, std::size_t first) {
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  for (std::size_t i = 0; i < Dim; ++i) {
    RunValuesOf<T> mv = {};
    add_up(state, run, state.nodal.sums.mv[i], mv);
    const T* inv_m = &nodes.inverse_mass(i)[first];
    T* v = &nodes.v[i][first];
    for (std::size_t k = 0; k < run.count; ++k) v[k] = mv[k] * inv_m[k];
  }
}

/// Control points next to a mirror (Walls::Mirror).  With the image of odd velocity, N_I v -
/// N_image v, the lumped kinetic energy is (m_I + m_image) v^2 / 2; in the open knot vector's
/// functions that is the mass of the point and of the held one beside it.  Without it the velocity
/// of a uniform strain comes out half as large again next to the wall, and N falls to 0 there while
/// its gradient does not: no step would be short enough.
template <int Dim, class Shape>
void mirror_inertia(State<Dim, Shape>& state, const Walls<Dim>& walls, const auto& run) {
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  for (std::size_t k = 0; k < run.count; ++k) {
    const int index = run.node + static_cast<int>(k);
    const auto* mirror = walls.mirror(index);
    if (!mirror) continue;
    for (std::size_t i = 0; i < Dim; ++i) {
      // Over this node and its images: one more along each axis with a mirror for component i.
      Real mass = 0.0;
      for (int images = 0; images < power(3, Dim); ++images) {
        int node = index;
        bool moves = true;
        for (std::size_t a = 0, rest = static_cast<std::size_t>(images); a < Dim; ++a, rest /= 3) {
          if (rest % 3 == 1) {
            node -= state.grid.node_stride[a];
            moves = moves && (mirror->lower[a] >> i & 1U);
          } else if (rest % 3 == 2) {
            node += state.grid.node_stride[a];
            moves = moves && (mirror->upper[a] >> i & 1U);
          }
        }
        if (moves) mass += nodes.m[static_cast<std::size_t>(node)];
      }
      nodes.inv_m[i][static_cast<std::size_t>(index)] =
          static_cast<T>(mass > 0.0 ? 1.0 / mass : 0.0);
    }
  }
}

/// m_I and (m v)_I, and v_I under the constraints.
template <int Dim, class Shape>
void gather_momentum_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  if (walls.have_mirrors()) std::ranges::fill(nodes.m, T(0)); // inactive ones are asked for as well
  for_each_node_run(state, [&](const auto& run, std::size_t) {
    const auto first = static_cast<std::size_t>(run.node);
    RunValuesOf<T> m = {};
    add_up(state, run, state.nodal.sums.m, m);
    for (std::size_t k = 0; k < run.count; ++k) {
      nodes.m[first + k] = m[k];
      const T inverse = T(1) / m[k];
      for (auto& inv_m : nodes.inv_m)
        if (!inv_m.empty()) inv_m[first + k] = m[k] > 0 ? inverse : T(0);
    }
    if (state.nodal.tracks_fraction) {
      RunValuesOf<T> V0 = {};
      add_up(state, run, state.nodal.sums.V0, V0);
      for (std::size_t k = 0; k < run.count; ++k) {
        const Real volume = state.nodal.volume[first + k]; // 0: beyond the grid; such are full
        nodes.fraction[first + k] =
            static_cast<T>(volume > 0.0 && V0[k] > 0 ? V0[k] / volume : 1.0);
      }
    }
    if (walls.have_mirrors()) return; // their masses need those of the nodes beside them
    find_velocities(state, run, first);
    constrain(nodes, walls, run);
  });
  if (!walls.have_mirrors()) return;
  for_each_node_run(state, [&](const auto& run, std::size_t) {
    mirror_inertia(state, walls, run);
    find_velocities(state, run, static_cast<std::size_t>(run.node));
    constrain(nodes, walls, run);
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
  using T = typename Shape::Number;
  Nodes<Dim, T>& nodes = state.nodal.nodes;
  state.nodal.damped.assign(state.order.node_runs().size(), 0.0);
  state.nodal.rubbed.assign(state.order.node_runs().size(), 0.0);
  for_each_node_run(state, [&](const auto& run, std::size_t number) {
    const auto first = static_cast<std::size_t>(run.node);
    std::array<RunValuesOf<T>, Dim> before, drag = {};
    for (std::size_t i = 0; i < Dim; ++i) {
      RunValuesOf<T> force = {};
      add_up(state, run, state.nodal.sums.f[i], force);
      const T* m = &nodes.m[first];
      const T* inv_m = &nodes.inverse_mass(i)[first];
      T* f = &nodes.f[i][first];
      T* v = &nodes.v[i][first];
      const auto b = static_cast<T>(gravity[i]), step = static_cast<T>(dt);
      for (std::size_t k = 0; k < run.count; ++k) {
        f[k] = force[k] + m[k] * b;
        before[i][k] = v[k];
      }
      if (damping > 0.0)
        for (std::size_t k = 0; k < run.count; ++k)
          drag[i][k] = v[k] != 0 ? static_cast<T>(-damping) * std::copysign(f[k], v[k]) : T(0);
      for (std::size_t k = 0; k < run.count; ++k) v[k] += step * inv_m[k] * (f[k] + drag[i][k]);
    }
    const bool at_walls = walls.touch(run.node, run.count);
    if (damping > 0.0 || at_walls) {
      const auto at = [](const std::array<RunValuesOf<T>, Dim>& values, std::size_t k) {
        Vec<Dim> value;
        for (std::size_t i = 0; i < Dim; ++i) value[i] = values[i][k];
        return value;
      };
      change_velocities(nodes, run, [&](int index, Vec<Dim>& v) {
        const auto k = static_cast<std::size_t>(index - run.node);
        walls.constrain(index, v);
        if (walls.have_friction()) {
          Vec<Dim> free = v;
          walls.hold_back(index, free);
          walls.resist(index, v);
          state.nodal.rubbed[number] += taken_work<Dim>(at(before, k), v, [&](std::size_t i) {
            return nodes.m[first + k] * (free[i] - v[i]);
          });
        }
        if (damping > 0.0)
          state.nodal.damped[number] +=
              taken_work<Dim>(at(before, k), v, [&](std::size_t i) { return -dt * drag[i][k]; });
      });
    }
    for (std::size_t i = 0; i < Dim; ++i) {
      const T* v = &nodes.v[i][first];
      T* dv = &nodes.dv[i][first];
      for (std::size_t k = 0; k < run.count; ++k) dv[k] = v[k] - before[i][k];
    }
  });
}

/// MUSL: v_I from the points' updated momenta; masses and weights are those of the first mapping.
template <int Dim, class Shape>
void remap_velocity_pass(State<Dim, Shape>& state, const Walls<Dim>& walls) {
  for_each_node_run(state, [&](const auto& run, std::size_t) {
    find_velocities(state, run, static_cast<std::size_t>(run.node));
    constrain(state.nodal.nodes, walls, run);
  });
}

} // namespace scarp
