// Cells to points (G2P), a point and a node at a time: what core/gather_pass.hpp does fast.
// The points' velocities and the step's displacement; for MUSL the new
// momenta go back to the cells' corners in the same sweep.
#pragma once

#include "core/affine.hpp"
#include "core/reference/strips.hpp"
#include "core/state.hpp"

#include <algorithm>
#include <cmath>

namespace scarp::reference {

/// dx_p = dt sum_I N_I v_I
/// v_p  = flip (v_p + sum_I N_I dv_I) + (1 - flip) sum_I N_I v_I
/// Remap: (m v)_I = sum_p m_p v_p N_I.
/// Affine transfers: C_p = sum_I v_I (x) q_I (core/affine.hpp), and m_p (v_p + C_p (x_I - x_p))
/// N_I.
/// Returns the largest of |v_p| and |sum_I N_I v_I|, m/s; with gradients at a control point's
/// distance, |v_p| + h/2 |C_p|.
template <int Dim, bool remap, class Shape>
Real gather_pass(State<Dim, Shape>& state, Real flip, Real dt) {
  constexpr std::size_t corners = State<Dim, Shape>::corners;
  const bool affine = state.particles.affine();
  Particles<Dim>& points = state.particles;
  Real fastest2 = 0.0;
  const Corners<Dim, Shape> all_corners(state);
  const std::int64_t blocks = block_count(state);
#pragma omp parallel for schedule(static) reduction(max : fastest2)
  for (std::int64_t b = 0; b < blocks; ++b) {
    const CellBlock block = cell_block(state, b);
    for (std::size_t slot = block.first_slot; slot < block.end_slot; ++slot) {
      std::array<Vec<Dim>, corners> v_I;
      std::array<Vec<Dim>, corners> dv_I;
      for (std::size_t i = 0; i < Dim; ++i) {
        const auto v = all_corners.of(state.nodal.nodes.v[i], state.order.place(slot).first_node);
        const auto dv = all_corners.of(state.nodal.nodes.dv[i], state.order.place(slot).first_node);
        for (std::size_t c = 0; c < corners; ++c) {
          v_I[c][i] = v(c);
          dv_I[c][i] = dv(c);
        }
      }
      std::array<std::array<Real, corners>, Dim> mv_I = {};
      const StencilCell<Dim> cell = stencil_cell(state, slot);

      for (std::size_t k = state.order.begin(slot); k < state.order.end(slot); ++k) {
        const std::size_t p = state.order.row(k);
        const Shape shape = shape_at(state, cell, p);
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
          if (!state.moves_with_strain) points.dx[i][p] = dt * v_grid[i];
          v2 += v_p[i] * v_p[i];
          v_grid2 += v_grid[i] * v_grid[i];
        }
        Real speed = std::sqrt(std::max(v2, v_grid2));
        if (affine) {
          gather_affine<Dim>(points, v_I, shape, local_position(state, cell, p), cell, p);
          Real C2 = 0.0;
          for (const Column& C : points.C) C2 += C[p] * C[p];
          speed += 0.5 * state.grid.h * std::sqrt(C2);
        }
        fastest2 = std::max(fastest2, speed * speed);
        if constexpr (remap) {
          if (affine)
            add_affine_momentum<Dim>(mv_I, points, shape, local_position(state, cell, p), cell, p);
          const Real m = points.m[p];
          for (std::size_t c = 0; c < corners; ++c)
            for (std::size_t i = 0; i < Dim; ++i) mv_I[i][c] += m * v_p[i] * shape.N[c];
        }
      }
      if constexpr (remap)
        for (std::size_t i = 0; i < Dim; ++i)
          add_to_strip<Shape>(state, slot, mv_I[i], state.nodal.sums.mv[i]);
    }
  }
  return std::sqrt(fastest2);
}

} // namespace scarp::reference
