// Points to cells (P2G): lumped mass, momentum and internal force of the nodes a cell reaches.
#pragma once

#include "core/affine_lanes.hpp"
#include "core/reference/scatter_pass.hpp"

namespace scarp {

/// Gives points k to end, those of a cell, their mean of the mean stress: sum V0 p / sum V0.
template <int Dim, class T>
void average_mean_stress(BlockLines<tensor_size<Dim>, T>& V_tau, const T* V0, std::size_t begin,
                         std::size_t end) {
  T sum = 0, weight = 0;
  const auto trace_at = [&](std::size_t k) { return V_tau[0][k] + V_tau[1][k] + V_tau[2][k]; };
  for (std::size_t k = begin; k < end; ++k) {
    sum += trace_at(k);
    weight += V0[k];
  }
  for (std::size_t k = begin; k < end; ++k) {
    const T excess = (V0[k] * (sum / weight) - trace_at(k)) * number<T>(1.0 / 3.0);
    for (std::size_t i = 0; i < 3; ++i) V_tau[i][k] += excess;
  }
}

/// m_I = sum_p m_p N_I,  (m v)_I = sum_p m_p v_p N_I,
/// f_I = - sum_p V0_p tau_p . grad N_I                                     (Wu 2017, section 1)
/// with the Kirchhoff stress tau = J sigma, so V0 tau = V sigma: see core/stress_pass.hpp.
/// Where regions differ in their body force, f_I also takes sum_p m_p b_p N_I with `own_force`, the
/// region's body force beyond the common one, m/s2; empty: they do not.
/// Affine transfers: v_p + C_p (x_I - x_p) instead of v_p.
/// Cell averages of the volumetric strain: in f_I the mean stress of a point is that of its cell,
/// sum_p V0_p p_p / sum_p V0_p; see core/stress_pass.hpp.
///
/// First the products, with points in the lanes of registers; then each point in turn adds to all
/// nodes of its cell, which are in the lanes.  What belongs to nodes of the next cell along x is
/// carried over to it.
template <int Dim, Terms terms, class Shape>
void scatter_pass(State<Dim, Shape>& state, const std::vector<Vec<Dim>>& own_force = {}) {
  if constexpr (!has_lanes<Shape>) {
    reference::scatter_pass<Dim, terms>(state, own_force);
  } else {
    using T = typename Shape::Number;
    const bool affine = state.particles.affine();
    constexpr bool momentum = terms != Terms::force;
    constexpr bool force = terms != Terms::mass_momentum;
    using AtNodes = NodeLanes<Shape::nodes, T>;
    StripSums<Dim, Shape>& sums = state.nodal.sums;
    sums.resize(state.order.entries(), state.nodal.tracks_fraction);
    const Particles<Dim, T>& points = state.particles;
    const bool tracks_fraction = state.nodal.tracks_fraction;
    const bool regions_differ = !own_force.empty();
    const std::int64_t blocks = block_count(state);
#pragma omp parallel
    {
      BlockLines<Dim, T> xi, m_v;
      BlockLines<Dim * Dim, T> m_C;
      BlockLines<1, T> m_p, V0_p;
      BlockLines<tensor_size<Dim>, T> V_tau;
#pragma omp for schedule(static)
      for (std::int64_t b = 0; b < blocks; ++b) {
        const CellBlock block = cell_block(state, b);
        xi.resize(block.size);
        m_v.resize(block.size);
        if (affine) m_C.resize(block.size);
        m_p.resize(block.size);
        V0_p.resize(block.size);
        V_tau.resize(block.size);
        for (std::size_t k = 0; k < block.size; k += RowPack<T>::capacity) {
          const RowPack<T> rows = block.pack<T>(k);
          const std::array<Pack<T>, Dim> place = local_position(state, rows);
          const Pack<T> m = rows.load(points.m);
          const Pack<T> V0 = rows.load(points.V0);
          store_lanes(m, m_p[0] + k);
          store_lanes(V0, V0_p[0] + k);
          for (std::size_t i = 0; i < Dim; ++i) {
            store_lanes(place[i], xi[i] + k);
            if constexpr (momentum) store_lanes(m * rows.load(points.v[i]), m_v[i] + k);
          }
          if constexpr (momentum)
            if (affine)
              for (std::size_t i = 0; i < points.C.size(); ++i)
                store_lanes(m * rows.load(points.C[i]), m_C[i] + k);
          if constexpr (force)
            for (std::size_t i = 0; i < tensor_size<Dim>; ++i)
              store_lanes(V0 * rows.load(points.tau[i]), V_tau[i] + k);
        }

        StripSum<Dim, Shape> m_strip, V0_strip;
        std::array<StripSum<Dim, Shape>, Dim> mv_strip, f_strip;
        std::size_t k = 0;
        for (std::size_t slot = block.first_slot; slot < block.end_slot; ++slot) {
          const std::size_t end = k + state.order.end(slot) - state.order.begin(slot);
          const StencilCell<Dim> cell = stencil_cell(state, slot);
          const typename Shape::Lanes functions(cell);
          const MomentumLanes<Dim, Shape> momentum_of(cell, affine);
          if (force && state.averages_volume) average_mean_stress<Dim, T>(V_tau, V0_p[0], k, end);
          AtNodes m, V0;
          std::array<AtNodes, Dim> mv, f;
          for (; k < end; ++k) {
            Vec<Dim, T> place;
            for (std::size_t i = 0; i < Dim; ++i) place[i] = xi[i][k];
            const StencilLanes<Dim, Shape::nodes, T> at = functions(place);
            if constexpr (momentum) {
              m += at.N * m_p[0][k];
              if (tracks_fraction) V0 += at.N * V0_p[0][k];
              momentum_of.add(mv, at.N, place, m_v, m_C, k);
            }
            if constexpr (force) {
              for (std::size_t i = 0; i < Dim; ++i)
                for (std::size_t j = 0; j < Dim; ++j)
                  f[i] +=
                      at.dN[j] * V_tau[component<Dim>(static_cast<int>(i), static_cast<int>(j))][k];
              if (regions_differ) // what is added here is multiplied by - 1/h below
                for (std::size_t i = 0; i < Dim; ++i)
                  f[i] += at.N * (m_p[0][k] *
                                  number<T>(-cell.h * own_force[points.region[block.rows[k]]][i]));
            }
          }
          const std::size_t entry = state.order.place(slot).entry;
          const bool last = !state.order.strip_goes_on(slot);
          if constexpr (momentum) {
            m_strip.add(m, sums.m, entry, last);
            if (tracks_fraction) V0_strip.add(V0, sums.V0, entry, last);
            for (std::size_t i = 0; i < Dim; ++i) mv_strip[i].add(mv[i], sums.mv[i], entry, last);
          }
          if constexpr (force)
            for (std::size_t i = 0; i < Dim; ++i)
              f_strip[i].add(f[i] * number<T>(-cell.inv_h), sums.f[i], entry, last);
        }
      }
    }
  }
}

} // namespace scarp
