// The points' motion, a point and a node at a time: what core/move_pass.hpp does fast.
#pragma once

#include "core/move_pass.hpp"

namespace scarp::reference {

/// x_p += dt sum_I N_I v_I, except for points that would leave the grid.
template <int Dim, class Shape> LostPoints move_pass(State<Dim, Shape>& state, Real dt) {
  Particles<Dim>& points = state.particles;
  LostPoints lost;
  for (const auto& cell : state.order.cells())
    for (std::size_t k = 0; k < cell.count; ++k) {
      const std::size_t p = cell.row(k);
      const Shape shape = shape_at(state, stencil_cell(state, cell), p);
      Vec<Dim> x = points.position(p);
      for (std::size_t i = 0; i < Dim; ++i) {
        const auto v = at_nodes(state, cell, moving_velocity(state)[i]);
        for (std::size_t c = 0; c < Shape::nodes; ++c) x[i] += dt * shape.N[c] * v(c);
      }
      if (!state.grid.contains(x))
        for (std::size_t i = 0; i < Dim; ++i)
          x[i] = short_of_sides(state.grid, i, points.x[i][p], x[i]);
      if (!(points.J[p] > 0.0)) lost.turned_over = std::min(lost.turned_over, points.id[p]);
      if (state.grid.contains(x))
        for (std::size_t i = 0; i < Dim; ++i) points.x[i][p] = x[i];
      else
        lost.outside = std::min(lost.outside, points.id[p]);
    }
  return lost;
}

} // namespace scarp::reference
