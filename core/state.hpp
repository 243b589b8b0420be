// Everything that changes during a run, for the passes over cells and nodes.
#pragma once

#include "core/cell_order.hpp"
#include "core/grid_index.hpp"
#include "core/linear_shape.hpp"
#include "core/nodes.hpp"
#include "core/particles.hpp"

#include <cstdint>
#include <type_traits>

namespace scarp {

template <int Dim> struct State {
  GridIndex<Dim> grid;
  Particles<Dim> particles;
  CellOrder<Dim> order;
  GridState<Dim> nodal;

  State(const Grid& scene_grid, Particles<Dim> points, bool tracks_fraction = false)
      : grid(scene_grid), particles(std::move(points)), order(grid), nodal(grid, tracks_fraction) {}
  State(const State&) = delete; // `order` points to `grid`
  State& operator=(const State&) = delete;
};

/// Calls visit(slot) for every occupied cell, on all threads.
template <int Dim, class Visit> void for_each_cell(const State<Dim>& state, Visit&& visit) {
  const auto n = static_cast<std::int64_t>(state.order.cells());
#pragma omp parallel for schedule(static)
  for (std::int64_t s = 0; s < n; ++s) visit(static_cast<std::size_t>(s));
}

/// Calls visit(node) for every active CellOrder::Node, on all threads.
template <int Dim, class Visit> void for_each_node(const State<Dim>& state, Visit&& visit) {
  const auto n = static_cast<std::int64_t>(state.order.nodes().size());
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) visit(state.order.nodes()[static_cast<std::size_t>(k)]);
}

/// Shape functions of a cell's corners at row p; `corner` is the cell's lowest corner in cells.
template <int Dim>
[[gnu::always_inline]] inline LinearShape<Dim>
shape_at(const State<Dim>& state, const std::type_identity_t<Vec<Dim>>& corner, std::size_t p) {
  Vec<Dim> xi;
  for (std::size_t i = 0; i < Dim; ++i)
    xi[i] = state.grid.scaled(state.particles.x[i][p], i) - corner[i];
  return LinearShape<Dim>(xi, state.grid.inv_h);
}

/// Lowest corner of a cell, in cells from the grid's lower corner.
template <int Dim> Vec<Dim> corner_of(const GridIndex<Dim>& grid, int cell) {
  Vec<Dim> corner;
  for (int a = Dim - 1; a >= 0; --a) {
    const auto i = static_cast<std::size_t>(a);
    const int along = cell / grid.cell_stride[i];
    corner[i] = along;
    cell %= grid.cell_stride[i];
  }
  return corner;
}

} // namespace scarp
