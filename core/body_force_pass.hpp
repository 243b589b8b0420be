// A body force that differs from place to place and with time, added to the cells' forces.
#pragma once

#include "core/scene.hpp"
#include "core/state.hpp"

namespace scarp {

/// f_I += sum_p m_p b(x_p, t) N_I, after the scatter pass; x_p is where the point is now.
template <int Dim, class Shape>
void body_force_pass(State<Dim, Shape>& state, const BodyForceField& field, Real time) {
  const Particles<Dim, typename Shape::Number>& points = state.particles;
  for_each_tile(state, [&](std::size_t tile) {
    for_each_cell_of(state, tile, [&](const auto& cell) {
      const StencilCell<Dim> stencil = stencil_cell(state, cell);
      for (std::size_t k = 0; k < cell.count; ++k) {
        const std::size_t p = cell.row(k);
        const Shape shape = shape_at(state, stencil, p);
        std::array<double, 3> place = {};
        for (int a = 0; a < Dim; ++a)
          place[scene_axis<Dim>(a)] = points.x[static_cast<std::size_t>(a)][p];
        const std::array<double, 3> b = field(place, time);
        for (int a = 0; a < Dim; ++a)
          for (std::size_t c = 0; c < shape.nodes; ++c)
            state.nodal.sums
                .f[static_cast<std::size_t>(a)][c / Shape::width][cell.entry + c % Shape::width] +=
                static_cast<typename Shape::Number>(points.mass(p) * b[scene_axis<Dim>(a)] *
                                                    shape.N[c]);
      }
    });
  });
}

} // namespace scarp
