// Cells to points (G2P): the points' velocities; for MUSL the new momenta go back to the cells'
// nodes in the same sweep.
#pragma once

#include "core/rank_weights.hpp"
#include "core/state.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {

/// Returns the squares of the largest speeds, by lane.
template <int Dim, bool affine, bool keeps, class Shape>
[[gnu::hot]] Pack<typename Shape::Number> gather_tile(State<Dim, Shape>& state,
                                                      std::size_t number_of_tile, bool remap,
                                                      [[maybe_unused]] Real flip) {
  using T = typename Shape::Number;
  using Sums = TileSums<Dim, Shape>;
  Particles<Dim, T>& points = state.particles;
  const Nodes<Dim, T>& nodes = state.nodal.nodes;
  const TileLanes<Dim, Shape> tile(state, number_of_tile);
  std::array<typename Sums::OfCells, Dim> mv;
  unrolled<Dim>([&](auto i) __attribute__((always_inline)) { Sums::clear(mv[i]); });
  Pack<T> fastest2 = T(0);
  for (const auto rank : tile.ranks()) {
    const std::size_t row = rank.row;
    const auto empty = !tile.filled(rank);
    const std::array<Pack<T>, Dim> xi = tile.local_position(rank);
    const RankWeights<Dim, Shape> weights(xi, tile.stencil());
    const auto& w = weights.along.w;
    const Pack<T> m = load_masses(points, row, load_lanes(&points.V0[row]));
    // flip (what they had + what the step has added) + (1 - flip) what the nodes have.
    const auto update = [&](const auto& functions, const auto& v_I, const auto& dv_I, auto& column)
        __attribute__((always_inline)) {
      const Pack<T> of_nodes = interpolate(functions, tile.at_nodes(v_I));
      Pack<T> now = of_nodes;
      if constexpr (keeps)
        now = number<T>(flip) *
                  (load_lanes(&column[row]) + interpolate(functions, tile.at_nodes(dv_I))) +
              number<T>(1.0 - flip) * of_nodes;
      where(empty, now) = 0.0F;
      store_lanes(now, &column[row]);
      return std::array{now, of_nodes};
    };
    std::array<Pack<T>, Dim> m_v;
    Pack<T> v2 = T(0), v_grid2 = T(0);
    unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
      auto [v, v_I] = update(w, nodes.v[i], nodes.dv[i], points.v[i]);
      where(empty, v_I) = 0.0F;
      m_v[i] = m * v;
      v2 += v * v;
      v_grid2 += v_I * v_I;
    });
    v2 = max(v2, v_grid2);
    std::array<Pack<T>, static_cast<std::size_t>(Dim) * Dim> m_C;
    if constexpr (affine) {
      const auto q = affine_functions<Dim, Shape>(xi, weights.along, tile.stencil());
      Pack<T> C2 = T(0);
      unrolled<Dim>([&](auto j) __attribute__((always_inline)) {
        auto functions = w;
        functions[j] = q[j];
        unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
          const Pack<T> C = update(functions, nodes.v[i], nodes.dv[i], points.C[Dim * i + j])[0];
          m_C[Dim * i + j] = m * C;
          C2 += C * C;
        });
      });
      const Pack<T> beside = sqrt(v2) + number<T>(0.5 * state.grid.h) * sqrt(C2);
      v2 = beside * beside;
    }
    fastest2 = max(fastest2, v2);
    if (remap) add_momenta<Dim, Shape, affine>(mv, weights, xi, m_v, m_C, state.grid.h);
  }
  if (remap)
    unrolled<Dim>([&](auto i) { Sums::add_up(mv[i], state.nodal.sums.mv[i], number_of_tile); });
  return fastest2;
}

/// v_p  = flip (v_p + sum_I N_I dv_I) + (1 - flip) sum_I N_I v_I
/// Remap: (m v)_I = sum_p m_p v_p N_I.
/// Affine transfers: C_p likewise with q_I (core/affine.hpp), and m_p (v_p + C_p (x_I - x_p)) N_I.
/// Returns the largest of |v_p| and |sum_I N_I v_I|, m/s; with gradients at a control point's
/// distance, |v_p| + h/2 |C_p|.
template <int Dim, bool remap, class Shape> Real gather_pass(State<Dim, Shape>& state, Real flip) {
  using T = typename Shape::Number;
  Real fastest2 = 0.0;
  const auto tiles = static_cast<std::int64_t>(state.order.tiles().size());
  with_flag(state.particles.affine(), [&](auto affine) {
    with_flag(flip > 0.0, [&](auto keeps) {
#pragma omp parallel reduction(max : fastest2)
      {
        Pack<T> of_thread = T(0);
#pragma omp for schedule(static)
        for (std::int64_t k = 0; k < tiles; ++k) {
          const auto tile = static_cast<std::size_t>(k);
          of_thread =
              max(of_thread, gather_tile<Dim, affine.value, keeps.value>(state, tile, remap, flip));
        }
        fastest2 = std::max(fastest2, static_cast<Real>(hmax(of_thread)));
      }
    });
  });
  return std::sqrt(fastest2);
}

} // namespace scarp
