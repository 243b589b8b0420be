// Which nodes the sides of the grid act on: contact of a body with a side.
//
// Quadratic B-splines feel a side from a whole cell away.  If it acts there, a point at the
// distance x, in cells, is held by only the part 2 - 2 x of its stress (d/dx of N_inner - N_outer +
// N_next): with modulus K it bears a load q at 1 - x = (q/2K)^(1/3), with the stress (q/2)
// (2K/q)^(1/3), which for a stiff body is many times the load.  So a side acts on a pair of nodes
// only
//
//   from the step on in which a point that the pair reaches will have come within half a point of
//   it, where its edge touches; with the point's velocity and the body force, so that it cannot
//   pass the side in one step, until no point that the pair reaches is in the first cell,
//
// and not, or no more, on a body on its way there.  What has touched is held as it would be
// anyway, both ways at fixed and symmetry sides.
//
// Whatever pairs act, they take part of the motion away by a projection in the metric of kinetic
// energy (core/walls.hpp), so the step's bound holds; a contact that begins only takes energy, as
// an impact without rebound of the nodes beside the side, and one that ends changes nothing.
#pragma once

#include "core/state.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <type_traits>
#include <vector>

namespace scarp {

/// Finds the pairs that the sides act on: those that a cell reaches in which a point is not farther
/// from the side, in cells, than half_size(p) and the way that the fastest one makes, v = way(v).
template <int Dim, class Shape>
void find_contacts(State<Dim, Shape>& state, const auto& half_size, const auto& way) {
  constexpr Real rounding = 1e-6; // cells; a body that fills its cells lies at half a point
  enum : std::uint8_t { reached = 1, touched = 2, held = 4 };
  const GridIndex<Dim>& grid = state.grid;
  std::vector<std::uint8_t>& marks = state.marks;
  marks.resize(static_cast<std::size_t>(grid.node_count), 0);
  const auto mark = [&](int node) -> std::uint8_t& {
    return marks[static_cast<std::size_t>(node)];
  };
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      auto& contacts = state.contacts[axis][side];
      const auto for_each_cell = [&](const auto& visit) {
        for (const std::uint32_t tile : state.order.side_tiles(axis, side))
          for_each_cell_of(state, tile, [&](const auto& cell) {
            if (cell.along[axis] == (side == 0 ? 0 : grid.cells[axis] - 1)) visit(cell);
          });
      };
      const auto touches = [&](const auto& cell) {
        Real gap = 1.0, fastest = -std::numeric_limits<Real>::infinity();
        for (std::size_t k = 0; k < cell.count; ++k) {
          const std::size_t p = cell.row(k);
          const Real x = grid.scaled(state.particles.x[axis][p], axis);
          const Real v = state.particles.v[axis][p];
          gap = std::min(gap, (side == 0 ? x : grid.cells[axis] - x) - half_size(p));
          fastest = std::max(fastest, side == 0 ? -v : v);
        }
        return gap <= std::max(way(fastest), 0.0) + rounding;
      };
      for_each_cell([&](const auto& cell) {
        const std::uint8_t how = touches(cell) ? reached | touched : reached;
        for (std::size_t c = 0; c < Shape::nodes; ++c)
          mark(cell.first_node + grid.corner_offset[c]) |= how;
      });
      for (const auto& pair : contacts) mark(pair.outer) |= held;
      const auto acts = [&](const auto& pair) {
        // In a corner of the grid as on what it is an image of.
        const std::uint8_t how = mark(grid.inside(pair.outer, axis));
        return (how & touched) != 0 || how == (reached | held);
      };
      std::remove_cvref_t<decltype(contacts)> now;
      std::ranges::copy_if(state.order.side_pairs(axis, side), std::back_inserter(now), acts);
      for_each_cell([&](const auto& cell) {
        for (std::size_t c = 0; c < Shape::nodes; ++c)
          mark(cell.first_node + grid.corner_offset[c]) = 0;
      });
      for (const auto& pair : contacts) mark(pair.outer) = 0;
      contacts = std::move(now);
    }
}

/// Before the first step: a body touches the sides that its lattice begins at, its cut squares as
/// the others.
template <int Dim, class Shape> void begin_contacts(State<Dim, Shape>& state) {
  if constexpr (Shape::layout == NodeLayout::spline)
    find_contacts(
        state, [&](std::size_t) { return state.half_point; }, [](Real) { return 0.0; });
}

/// In a step; `body_force`: its size, m/s2.
template <int Dim, class Shape>
void find_contacts_pass(State<Dim, Shape>& state, Real body_force, Real dt) {
  if constexpr (Shape::layout == NodeLayout::spline)
    find_contacts(
        state,
        [&](std::size_t p) {
          return 0.5 * std::pow(state.particles.V0[p], 1.0 / Dim) * state.grid.inv_h;
        },
        [&](Real v) { return dt * (v + dt * body_force) * state.grid.inv_h; });
}

/// Lets sides act on all that they reach, as if it had touched them.
template <int Dim, class Shape> void touch_all(State<Dim, Shape>& state) {
  if constexpr (Shape::layout == NodeLayout::spline)
    for (std::size_t axis = 0; axis < Dim; ++axis)
      for (std::size_t side = 0; side < 2; ++side)
        state.contacts[axis][side] = state.order.side_pairs(axis, side);
}

} // namespace scarp
