// Points to cells (P2G): lumped mass, momentum and internal force of the nodes a cell reaches.
#pragma once

#include "core/rank_weights.hpp"
#include "core/state.hpp"
#include "core/transfer.hpp"

#include <vector>

namespace scarp {

/// By lane, the mean of the points' mean stresses in the cell: sum V0 p / sum V0.
template <int Dim, class Shape>
[[gnu::always_inline]] inline Pack<typename Shape::Number>
mean_stress_of_cells(const State<Dim, Shape>& state, const TileLanes<Dim, Shape>& tile) {
  using T = typename Shape::Number;
  Pack<T> sum = T(0), weight = T(0);
  for (const auto rank : tile.ranks()) {
    const std::size_t row = rank.row;
    const Pack<T> V0 = load_lanes(&state.particles.V0[row]);
    Pack<T> trace = T(0);
    for (std::size_t i = 0; i < 3; ++i) trace += load_lanes(&state.particles.tau[i][row]);
    sum += V0 * trace;
    weight += V0;
  }
  where(weight == 0.0F, weight) = 1.0F;
  return sum / weight * number<T>(1.0 / 3.0);
}

template <int Dim, bool affine, class Shape>
[[gnu::hot]] void scatter_tile(State<Dim, Shape>& state, std::size_t number_of_tile, Terms terms,
                               const std::vector<Vec<Dim>>& own_force) {
  using T = typename Shape::Number;
  using Sums = TileSums<Dim, Shape>;
  using OfCells = typename Sums::OfCells;
  const bool momentum = terms != Terms::force;
  const bool force = terms != Terms::mass_momentum;
  const Particles<Dim, T>& points = state.particles;
  const bool tracks_fraction = state.nodal.tracks_fraction;
  const TileLanes<Dim, Shape> tile(state, number_of_tile);
  Pack<T> mean = T(0);
  if (force && state.averages_volume) mean = mean_stress_of_cells(state, tile);

  OfCells m, V0;
  std::array<OfCells, Dim> mv, f;
  Sums::clear(m);
  Sums::clear(V0);
  unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
    Sums::clear(mv[i]);
    Sums::clear(f[i]);
  });

  for (const auto rank : tile.ranks()) {
    const std::size_t row = rank.row;
    const std::array<Pack<T>, Dim> xi = tile.local_position(rank);
    const RankWeights<Dim, Shape> weights(xi, tile.stencil());
    const Pack<T> V0_p = load_lanes(&points.V0[row]);
    const Pack<T> m_p = load_masses(points, row, V0_p);
    if (momentum) {
      std::array<Pack<T>, Dim> m_v;
      std::array<Pack<T>, static_cast<std::size_t>(Dim) * Dim> m_C;
      for (std::size_t i = 0; i < Dim; ++i) m_v[i] = m_p * load_lanes(&points.v[i][row]);
      if constexpr (affine)
        for (std::size_t i = 0; i < m_C.size(); ++i) m_C[i] = m_p * load_lanes(&points.C[i][row]);
      add_values<Dim, Shape>(m, weights, m_p);
      if (tracks_fraction) add_values<Dim, Shape>(V0, weights, V0_p);
      add_momenta<Dim, Shape, affine>(mv, weights, xi, m_v, m_C, state.grid.h);
    }
    if (force) {
      SymTensor<Dim, Pack<T>> tau;
      unrolled<tensor_size<Dim>>([&](auto i) __attribute__((always_inline)) {
        tau[i] = load_lanes(&points.tau[i][row]);
      });
      if (state.averages_volume) {
        const Pack<T> excess = mean - trace<Dim, Pack<T>>(tau) * number<T>(1.0 / 3.0);
        for (std::size_t i = 0; i < 3; ++i) tau[i] += excess;
      }
      for (Pack<T>& component : tau) component *= V0_p;
      add_forces<Dim, Shape>(f, weights, tau);
      if (!own_force.empty())
        for (std::size_t i = 0; i < Dim; ++i)
          add_values<Dim, Shape>(f[i], weights,
                                 m_p * Pack<T>([&](auto lane) {
                                   return static_cast<T>(own_force[points.region[row + lane]][i]);
                                 }));
    }
  }

  Sums& sums = state.nodal.sums;
  if (momentum) {
    Sums::add_up(m, sums.m, number_of_tile);
    if (tracks_fraction) Sums::add_up(V0, sums.V0, number_of_tile);
    unrolled<Dim>([&](auto i) { Sums::add_up(mv[i], sums.mv[i], number_of_tile); });
  }
  if (force) unrolled<Dim>([&](auto i) { Sums::add_up(f[i], sums.f[i], number_of_tile); });
}

/// m_I = sum_p m_p N_I,  (m v)_I = sum_p m_p v_p N_I,
/// f_I = - sum_p V0_p tau_p . grad N_I                                     (Wu 2017, section 1)
/// with the Kirchhoff stress tau = J sigma, so V0 tau = V sigma: see core/stress_pass.hpp.
/// Where regions differ in their body force, f_I also takes sum_p m_p b_p N_I with `own_force`, the
/// region's body force beyond the common one, m/s2; empty: they do not.
/// Affine transfers: v_p + C_p (x_I - x_p) instead of v_p.
/// Cell averages of the volumetric strain: in f_I the mean stress of a point is that of its cell,
/// sum_p V0_p p_p / sum_p V0_p; see core/stress_pass.hpp.
template <int Dim, Terms terms, class Shape>
void scatter_pass(State<Dim, Shape>& state, const std::vector<Vec<Dim>>& own_force = {}) {
  state.nodal.sums.resize(state.order, state.nodal.tracks_fraction);
  with_flag(state.particles.affine(), [&](auto affine) {
    for_each_tile(state, [&](std::size_t tile) {
      scatter_tile<Dim, affine.value>(state, tile, terms, own_force);
    });
  });
}

} // namespace scarp
