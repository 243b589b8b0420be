// Cells to points (G2P), a point and a node at a time: what core/gather_pass.hpp does fast.
// The points' velocities; for MUSL the new momenta go back to the cells' corners in the same sweep.
#pragma once

#include "core/affine.hpp"
#include "core/reference/tiles.hpp"
#include "core/state.hpp"

#include <algorithm>
#include <cmath>

namespace scarp::reference {

/// v_p  = flip (v_p + sum_I N_I dv_I) + (1 - flip) sum_I N_I v_I
/// Remap: (m v)_I = sum_p m_p v_p N_I.
/// Affine transfers: C_p likewise with q_I (core/affine.hpp), and m_p (v_p + C_p (x_I - x_p)) N_I.
/// Returns the largest of |v_p| and |sum_I N_I v_I|, m/s; with gradients at a control point's
/// distance, |v_p| + h/2 |C_p|.
template <int Dim, bool remap, class Shape> Real gather_pass(State<Dim, Shape>& state, Real flip) {
  constexpr std::size_t corners = State<Dim, Shape>::corners;
  const bool affine = state.particles.affine();
  Particles<Dim>& points = state.particles;
  Real fastest2 = 0.0;
  const auto gather_cell = [&](const auto& cell) {
    std::array<Vec<Dim>, corners> v_I;
    std::array<Vec<Dim>, corners> dv_I;
    for (std::size_t i = 0; i < Dim; ++i)
      for (std::size_t c = 0; c < corners; ++c) {
        v_I[c][i] = at_nodes(state, cell, state.nodal.nodes.v[i])(c);
        dv_I[c][i] = at_nodes(state, cell, state.nodal.nodes.dv[i])(c);
      }
    std::array<std::array<Real, corners>, Dim> mv_I = {};
    const StencilCell<Dim> stencil = stencil_cell(state, cell);

    Real fastest2_of_cell = 0.0;
    for (std::size_t k = 0; k < cell.count; ++k) {
      const std::size_t p = cell.row(k);
      const Shape shape = shape_at(state, stencil, p);
      Vec<Dim> v_grid = {};
      Vec<Dim> dv_grid = {};
      for (std::size_t c = 0; c < corners; ++c) {
        for (std::size_t i = 0; i < Dim; ++i) {
          v_grid[i] += shape.N[c] * v_I[c][i];
          dv_grid[i] += shape.N[c] * dv_I[c][i];
        }
      }
      Vec<Dim> v_p;
      Real v2 = 0.0, v_grid2 = 0.0;
      for (std::size_t i = 0; i < Dim; ++i) {
        v_p[i] = flip * (points.v[i][p] + dv_grid[i]) + (1.0 - flip) * v_grid[i];
        points.v[i][p] = v_p[i];
        v2 += v_p[i] * v_p[i];
        v_grid2 += v_grid[i] * v_grid[i];
      }
      Real speed = std::sqrt(std::max(v2, v_grid2));
      if (affine) {
        gather_affine<Dim>(points, v_I, dv_I, flip, shape, local_position(state, stencil, p),
                           stencil, p);
        Real C2 = 0.0;
        for (const Column& C : points.C) C2 += C[p] * C[p];
        speed += 0.5 * state.grid.h * std::sqrt(C2);
      }
      fastest2_of_cell = std::max(fastest2_of_cell, speed * speed);
      if constexpr (remap) {
        if (affine)
          add_affine_momentum<Dim>(mv_I, points, shape, local_position(state, stencil, p), stencil,
                                   p);
        const Real m = points.mass(p);
        for (std::size_t c = 0; c < corners; ++c)
          for (std::size_t i = 0; i < Dim; ++i) mv_I[i][c] += m * v_p[i] * shape.N[c];
      }
    }
    if constexpr (remap)
      for (std::size_t i = 0; i < Dim; ++i)
        add_to_tile<Dim, Shape>(cell, mv_I[i], state.nodal.sums.mv[i]);
    return fastest2_of_cell;
  };
  const auto tiles = static_cast<std::int64_t>(state.order.tiles().size());
#pragma omp parallel for schedule(static) reduction(max : fastest2)
  for (std::int64_t k = 0; k < tiles; ++k) {
    const auto tile = static_cast<std::size_t>(k);
    if constexpr (remap)
      for (auto& sums : state.nodal.sums.mv) clear_tile<Dim, Shape>(tile, sums);
    for_each_cell_of(state, tile,
                     [&](const auto& cell) { fastest2 = std::max(fastest2, gather_cell(cell)); });
  }
  return std::sqrt(fastest2);
}

} // namespace scarp::reference
