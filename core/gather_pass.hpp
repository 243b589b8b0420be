// Cells to points (G2P): the points' velocities and, unless it comes with the strain, the step's
// displacement; for MUSL the new momenta go back to the cells' nodes in the same sweep.
#pragma once

#include "core/affine_lanes.hpp"
#include "core/reference/gather_pass.hpp"

#include <cmath>

namespace scarp {

/// dx_p = dt sum_I N_I v_I
/// v_p  = flip (v_p + sum_I N_I dv_I) + (1 - flip) sum_I N_I v_I
/// Remap: (m v)_I = sum_p m_p v_p N_I.
/// Affine transfers: C_p = sum_I v_I (x) q_I (core/affine.hpp), and m_p (v_p + C_p (x_I - x_p))
/// N_I.
/// Returns the largest of |v_p| and |sum_I N_I v_I|, m/s; with gradients at a control point's
/// distance, |v_p| + h/2 |C_p|.
template <int Dim, bool remap, class Shape>
Real gather_pass(State<Dim, Shape>& state, Real flip, Real dt) {
  if constexpr (!has_lanes<Shape>) {
    return reference::gather_pass<Dim, remap>(state, flip, dt);
  } else {
    using T = typename Shape::Number;
    const bool affine = state.particles.affine();
    using AtNodes = NodeLanes<Shape::nodes, T>;
    Particles<Dim, T>& points = state.particles;
    const Nodes<Dim, T>& nodes = state.nodal.nodes;
    const Corners<Dim, Shape> corners(state);
    Real fastest2 = 0.0;
    const std::int64_t blocks = block_count(state);
#pragma omp parallel reduction(max : fastest2)
    {
      BlockLines<Dim, T> xi, v_grid, dv_grid, m_v;
      BlockLines<Dim * Dim, T> C; // and for the remap, once the points have it: m C
      Pack<T> fastest = 0.0F;     // v2 of this thread's points, by lane
#pragma omp for schedule(static)
      for (std::int64_t b = 0; b < blocks; ++b) {
        const CellBlock block = cell_block(state, b);
        xi.resize(block.size);
        v_grid.resize(block.size);
        dv_grid.resize(block.size);
        m_v.resize(block.size);
        if (affine) C.resize(block.size);
        for (std::size_t k = 0; k < block.size; k += RowPack<T>::capacity) {
          const std::array<Pack<T>, Dim> place = local_position(state, block.pack<T>(k));
          for (std::size_t i = 0; i < Dim; ++i) store_lanes(place[i], xi[i] + k);
        }

        // Lanes beyond a cell's last point are written again with the next cell.
        std::size_t begin = 0;
        for (std::size_t slot = block.first_slot; slot < block.end_slot; ++slot) {
          const std::size_t end = begin + state.order.end(slot) - state.order.begin(slot);
          const StencilCell<Dim> cell = stencil_cell(state, slot);
          const int node = state.order.place(slot).first_node;
          for (std::size_t k = begin; k < end; k += Pack<T>::size()) {
            std::array<Pack<T>, Dim> place;
            for (std::size_t i = 0; i < Dim; ++i) place[i] = load_lanes(xi[i] + k);
            const auto along = Shape::along(place, cell);
            const auto& w = along.w;
            for (std::size_t i = 0; i < Dim; ++i) {
              store_lanes(interpolate(w, corners.of(nodes.v[i], node)), v_grid[i] + k);
              store_lanes(interpolate(w, corners.of(nodes.dv[i], node)), dv_grid[i] + k);
            }
            if (affine) {
              const auto q = affine_functions<Dim, Shape>(place, along, cell);
              for (std::size_t j = 0; j < Dim; ++j) {
                auto functions = w;
                functions[j] = q[j];
                for (std::size_t i = 0; i < Dim; ++i)
                  store_lanes(interpolate(functions, corners.of(nodes.v[i], node)),
                              C[Dim * i + j] + k);
              }
            }
          }
          begin = end;
        }

        for (std::size_t k = 0; k < block.size; k += RowPack<T>::capacity) {
          const RowPack<T> rows = block.pack<T>(k);
          const Pack<T> m = rows.load(points.m);
          Pack<T> v2 = 0.0F, v_grid2 = 0.0F, C2 = 0.0F;
          for (std::size_t i = 0; i < Dim; ++i) {
            const Pack<T> v_I = load_lanes(v_grid[i] + k);
            const Pack<T> dv_I = load_lanes(dv_grid[i] + k);
            const Pack<T> v =
                number<T>(flip) * (rows.load(points.v[i]) + dv_I) + number<T>(1.0 - flip) * v_I;
            rows.store(v, points.v[i]);
            if (!state.moves_with_strain) rows.store(number<T>(dt) * v_I, points.dx[i]);
            if constexpr (remap) store_lanes(m * v, m_v[i] + k);
            v2 += v * v;
            v_grid2 += v_I * v_I;
          }
          for (std::size_t i = 0; affine && i < points.C.size(); ++i) {
            const Pack<T> C_i = load_lanes(C[i] + k);
            C2 += C_i * C_i;
            rows.store(C_i, points.C[i]);
            if constexpr (remap) store_lanes(m * C_i, C[i] + k);
          }
          v2 = max(v2, v_grid2);
          if (affine) {
            const Pack<T> beside = sqrt(v2) + number<T>(0.5 * state.grid.h) * sqrt(C2);
            v2 = beside * beside;
          }
          if (rows.size() == RowPack<T>::capacity)
            fastest = max(fastest, v2);
          else
            for (std::size_t lane = 0; lane < rows.size(); ++lane)
              fastest2 = std::max(fastest2, static_cast<Real>(v2[lane]));
        }

        if constexpr (remap) {
          std::array<StripSum<Dim, Shape>, Dim> mv_strip;
          std::size_t k = 0;
          for (std::size_t slot = block.first_slot; slot < block.end_slot; ++slot) {
            const std::size_t end = k + state.order.end(slot) - state.order.begin(slot);
            const StencilCell<Dim> cell = stencil_cell(state, slot);
            const typename Shape::Lanes functions(cell);
            const MomentumLanes<Dim, Shape> momentum_of(cell, affine);
            std::array<AtNodes, Dim> mv;
            for (; k < end; ++k) {
              Vec<Dim, T> place;
              for (std::size_t i = 0; i < Dim; ++i) place[i] = xi[i][k];
              momentum_of.add(mv, functions(place).N, place, m_v, C, k);
            }
            const std::size_t entry = state.order.place(slot).entry;
            const bool last = !state.order.strip_goes_on(slot);
            for (std::size_t i = 0; i < Dim; ++i)
              mv_strip[i].add(mv[i], state.nodal.sums.mv[i], entry, last);
          }
        }
      }
      fastest2 = std::max(fastest2, static_cast<Real>(hmax(fastest)));
    }
    return std::sqrt(fastest2);
  }
}

} // namespace scarp
