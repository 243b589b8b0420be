// Points to cells (P2G), a point and a node at a time: what core/scatter_pass.hpp does fast.
#pragma once

#include "core/affine.hpp"
#include "core/reference/tiles.hpp"
#include "core/state.hpp"
#include "core/transfer.hpp"

namespace scarp::reference {

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
  constexpr bool momentum = terms != Terms::force;
  constexpr bool force = terms != Terms::mass_momentum;
  using Lines = typename TileSums<Dim, Shape>::Lines;
  TileSums<Dim, Shape>& sums = state.nodal.sums;
  sums.resize(state.order, state.nodal.tracks_fraction);
  const Particles<Dim>& points = state.particles;
  [[maybe_unused]] const bool tracks_fraction = state.nodal.tracks_fraction;
  [[maybe_unused]] const bool affine = points.affine();

  const auto scatter_cell = [&](const auto& cell) {
    CellTile<Dim, Shape::nodes> tile = {};
    const StencilCell<Dim> stencil = stencil_cell(state, cell);
    [[maybe_unused]] const Real mean_of_cell =
        force && state.averages_volume
            ? cell_mean(state, cell, [&](std::size_t p) { return mean_stress(points, p); })
            : 0.0;

    for (std::size_t k = 0; k < cell.count; ++k) {
      const std::size_t p = cell.row(k);
      const Shape shape = shape_at(state, stencil, p);
      [[maybe_unused]] const Real m = points.mass(p);
      [[maybe_unused]] const Real V0 = points.V0[p];
      Vec<Dim> mv;
      Mat<Dim> V_sigma;
      for (std::size_t i = 0; i < Dim; ++i) {
        mv[i] = m * points.v[i][p];
        for (std::size_t j = 0; j < Dim; ++j)
          V_sigma[i][j] =
              V0 * points.tau[component<Dim>(static_cast<int>(i), static_cast<int>(j))][p];
      }
      if constexpr (force)
        if (state.averages_volume) {
          const Real excess = V0 * (mean_of_cell - mean_stress(points, p));
          for (std::size_t i = 0; i < Dim; ++i) V_sigma[i][i] += excess;
        }
      if constexpr (force)
        if (!own_force.empty())
          for (std::size_t c = 0; c < shape.nodes; ++c)
            for (std::size_t i = 0; i < Dim; ++i)
              tile.f[i][c] += m * own_force[points.region[p]][i] * shape.N[c];
      if constexpr (momentum)
        if (affine)
          add_affine_momentum<Dim>(tile.mv, points, shape, local_position(state, stencil, p),
                                   stencil, p);
      for (std::size_t c = 0; c < shape.nodes; ++c) {
        if constexpr (momentum) {
          if (tracks_fraction) tile.V0[c] += V0 * shape.N[c];
          tile.m[c] += m * shape.N[c];
          for (std::size_t i = 0; i < Dim; ++i) tile.mv[i][c] += mv[i] * shape.N[c];
        }
        if constexpr (force) {
          for (std::size_t i = 0; i < Dim; ++i)
            for (std::size_t j = 0; j < Dim; ++j) tile.f[i][c] -= V_sigma[i][j] * shape.dN[c][j];
        }
      }
    }
    const auto add = [&](const std::array<Real, Shape::nodes>& of_cell, Lines& to) {
      add_to_tile<Dim, Shape>(cell, of_cell, to);
    };
    if constexpr (momentum) {
      add(tile.m, sums.m);
      if (tracks_fraction) add(tile.V0, sums.V0);
      for (std::size_t i = 0; i < Dim; ++i) add(tile.mv[i], sums.mv[i]);
    }
    if constexpr (force)
      for (std::size_t i = 0; i < Dim; ++i) add(tile.f[i], sums.f[i]);
  };
  for_each_tile(state, [&](std::size_t tile) {
    if constexpr (momentum) {
      clear_tile<Dim, Shape>(tile, sums.m);
      if (tracks_fraction) clear_tile<Dim, Shape>(tile, sums.V0);
      for (std::size_t i = 0; i < Dim; ++i) clear_tile<Dim, Shape>(tile, sums.mv[i]);
    }
    if constexpr (force)
      for (std::size_t i = 0; i < Dim; ++i) clear_tile<Dim, Shape>(tile, sums.f[i]);
    for_each_cell_of(state, tile, scatter_cell);
  });
}

} // namespace scarp::reference
