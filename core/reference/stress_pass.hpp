// Stress of every point, a point and a node at a time: what core/stress_pass.hpp does fast.
#pragma once

#include "core/stress_pass.hpp"

#include <cmath>

namespace scarp::reference {

/// grad v = sum_I v_I (x) grad N_I.
template <int Dim, class Shape>
Mat<Dim> velocity_gradient(const State<Dim, Shape>& state, const auto& cell, std::size_t p) {
  const Shape shape = shape_at(state, stencil_cell(state, cell), p);
  Mat<Dim> grad_v = {};
  for (std::size_t i = 0; i < Dim; ++i) {
    const auto v = at_nodes(state, cell, state.nodal.nodes.v[i]);
    for (std::size_t c = 0; c < Shape::nodes; ++c)
      for (std::size_t j = 0; j < Dim; ++j) grad_v[i][j] += v(c) * shape.dN[c][j];
  }
  return grad_v;
}

template <int Dim, class Law, class Shape>
void stress_pass(State<Dim, Shape>& state, std::uint8_t material, const ElasticModuli& moduli,
                 const Law& law, bool opens, Real dt) {
  Particles<Dim>& points = state.particles;
  const auto update_cell = [&](const auto& cell) {
    const auto divergence = [&](std::size_t p) {
      const Mat<Dim> grad_v = velocity_gradient(state, cell, p);
      Real sum = 0.0;
      for (std::size_t i = 0; i < Dim; ++i) sum += grad_v[i][i];
      return sum;
    };
    const Real mean_rate = state.averages_volume ? cell_mean(state, cell, divergence) : 0.0;
    for (std::size_t k = 0; k < cell.count; ++k) {
      const std::size_t p = cell.row(k);
      if (points.material[p] != material) continue;
      const Shape shape = shape_at(state, stencil_cell(state, cell), p);
      const auto interpolated = [&](const Column& values) {
        Real sum = 0.0;
        for (std::size_t c = 0; c < Shape::nodes; ++c)
          sum += shape.N[c] * at_nodes(state, cell, values)(c);
        return sum;
      };
      const Real dilation = state.averages_volume ? mean_rate - divergence(p) : 0.0;
      Real gap = 0.0, room = 0.0;
      if (opens) {
        room = std::max(-std::log(interpolated(state.nodal.nodes.fraction)), 0.0);
        gap = points.gap[p];
      }
      SymTensor<Dim> tau;
      for (std::size_t i = 0; i < tau.size(); ++i) tau[i] = points.tau[i][p];
      const PlasticStep<> plastic =
          update_stress<Dim, Real>(tau, gap, room, velocity_gradient(state, cell, p), dilation, dt,
                                   moduli, law_in_step<Real>(law, points.plastic_strain[p], dt));
      for (std::size_t i = 0; i < tau.size(); ++i) points.tau[i][p] = tau[i];
      if (opens) points.gap[p] = gap;
      points.plastic_strain[p] += plastic.strain;
      points.dissipation[p] += plastic.dissipation;
      const Real grown = dt * (divergence(p) + dilation) - plastic.forgotten;
      points.J[p] *= std::abs(grown) > 0.5 ? std::exp(grown) : (2.0 + grown) / (2.0 - grown);
    }
  };
  for_each_tile(state, [&](std::size_t tile) { for_each_cell_of(state, tile, update_cell); });
}

} // namespace scarp::reference
