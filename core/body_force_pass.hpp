// A body force that differs from place to place and with time, added to the cells' forces.
#pragma once

#include "core/scene.hpp"
#include "core/state.hpp"

namespace scarp {

/// f_I += sum_p m_p b(x_p, t) N_I, after the scatter pass; x_p is where the point is now.
template <int Dim, class Shape>
void body_force_pass(State<Dim, Shape>& state, const BodyForceField& field, Real time) {
  const Particles<Dim, typename Shape::Number>& points = state.particles;
  for_each_cell(state, [&](std::size_t slot) {
    std::array<std::array<Real, Shape::nodes>, Dim> f = {};
    const StencilCell<Dim> cell = stencil_cell(state, slot);
    for (std::size_t k = state.order.begin(slot); k < state.order.end(slot); ++k) {
      const std::size_t p = state.order.row(k);
      const Shape shape = shape_at(state, cell, p);
      std::array<double, 3> place = {};
      for (int a = 0; a < Dim; ++a)
        place[scene_axis<Dim>(a)] = points.x[static_cast<std::size_t>(a)][p];
      const std::array<double, 3> b = field(place, time);
      for (std::size_t c = 0; c < shape.nodes; ++c)
        for (int a = 0; a < Dim; ++a)
          f[static_cast<std::size_t>(a)][c] += points.m[p] * b[scene_axis<Dim>(a)] * shape.N[c];
    }
    for (std::size_t i = 0; i < Dim; ++i)
      for (std::size_t c = 0; c < Shape::nodes; ++c)
        state.nodal.sums.f[i][c / Shape::width][state.order.place(slot).entry + c % Shape::width] +=
            static_cast<typename Shape::Number>(f[i][c]);
  });
}

} // namespace scarp
