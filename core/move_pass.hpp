// The points' motion, x_p += dt sum_I N_I v_I.
//
// Which velocity.  With MUSL the strain sees the remapped velocity v*; as published, points move
// with the one before it, v.  The two differ by what the points do not keep: a node that hardly
// carries mass has a velocity dt f/m afresh each step, and in v it moves the points beside it. Then
// strain and place drift apart, and a film that lies at rest on a wall creeps, by dt g (x/h)^2 / 2,
// against gravity.  With affine transfers points therefore move with v* (`moves_with_strain`): what
// gravity does to points is then what it does to nodes, and for a steady v* = R (v* + dt f/m), with
// the transfers there and back as a symmetric R between 0 and 1, the power f . v* of what is not in
// balance is never negative, so nothing at rest gains energy.
//
// At sides.  What is held has no velocity at the side itself, v(d) = d g with the distance d, so no
// path dd/dt = d g ends beyond it, but a step d + dt v does where dt g < -1: where forces have
// thrown a node so fast within one step that its length, which follows the speeds before it
// (core/time_step.hpp), was too long.  Such a point goes the path to its end, to d exp(dt v/d), as
// its volume does for such a strain (core/stress_pass.hpp), rather than through the side.
#pragma once

#include "core/rank_weights.hpp"
#include "core/state.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {

/// Points with which a run can not go on, the lowest ids; or no_point.
struct LostPoints {
  std::uint32_t outside = no_point;     ///< of the grid, or no number; is where it was
  std::uint32_t turned_over = no_point; ///< has a volume that is not positive
};

/// The nodal velocity that points move with.
template <int Dim, class Shape> const auto& moving_velocity(const State<Dim, Shape>& state) {
  return state.nodal.remapped && !state.moves_with_strain ? state.nodal.nodes.dv
                                                          : state.nodal.nodes.v;
}

/// m, where a point gets to along an axis that a step would take to `to`: see above.  Steps of more
/// than a cell are none that the time step allows, and stay.
template <int Dim>
Real short_of_sides(const GridIndex<Dim>& grid, std::size_t axis, Real from, Real to) {
  const Real cells = grid.cells[axis], x = grid.scaled(from, axis);
  const Real step = grid.scaled(to, axis) - x, left = cells - x;
  if (x + step < 0.0 && step > -1.0 && grid.closed[axis][0])
    return grid.lower[axis] + grid.h * (x * std::exp(step / x));
  if (x + step >= cells && step < 1.0 && grid.closed[axis][1])
    return grid.lower[axis] + grid.h * (cells - left * std::exp(-step / left));
  return to;
}

/// The points of one tile, except those that would leave the grid.  Sets State::left of it.
template <int Dim, class Shape>
[[gnu::hot]] LostPoints move_tile(State<Dim, Shape>& state, std::size_t number_of_tile, Real dt) {
  using T = typename Shape::Number;
  using Places = typename TileLanes<Dim, Shape>::Places;
  Particles<Dim, T>& points = state.particles;
  const auto& velocity = moving_velocity(state);
  const TileLanes<Dim, Shape> tile(state, number_of_tile);
  LostPoints lost;
  bool left = false;
  const auto note = [&](const auto& which, std::size_t row, std::uint32_t& lowest) {
    for (std::size_t lane = 0; lane < tile_cells<T>; ++lane)
      if (which[lane]) lowest = std::min(lowest, points.id[row + lane]);
  };
  for (const auto rank : tile.ranks()) {
    const auto w = Shape::along(tile.local_position(rank), tile.stencil()).w;
    std::array<Places, Dim> x;
    auto stays = Places(0.0) == 0.0; // in its cell
    unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
      const Pack<T> dx = number<T>(dt) * interpolate(w, tile.at_nodes(velocity[i]));
      x[i] = tile.position(rank, i) + std::experimental::static_simd_cast<Places>(dx);
      const Places xi = tile.in_cells(x[i], i);
      stays = stays && xi >= 0.0 && xi < 1.0;
    });
    auto goes = tile.filled_places(rank);
    if (const auto leaves = goes && !stays; any_of(leaves)) {
      left = true;
      for (std::size_t lane = 0; lane < tile_cells<T>; ++lane) {
        if (!leaves[lane]) continue;
        Vec<Dim> to;
        for (std::size_t i = 0; i < Dim; ++i) {
          to[i] = short_of_sides(state.grid, i, tile.position(rank, i)[lane], x[i][lane]);
          x[i][lane] = to[i];
        }
        goes[lane] = state.grid.contains(to);
      }
      if (const auto outside = leaves && !goes; any_of(outside))
        note(outside, rank.row, lost.outside);
    }
    unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
      Places all = tile.position(rank, i);
      where(goes, all) = x[i];
      all.copy_to(&points.x[i][rank.row], std::experimental::element_aligned);
    });
    if (const auto bad = !(load_lanes(&points.J[rank.row]) > 0.0F); any_of(bad))
      note(bad, rank.row, lost.turned_over);
  }
  state.left[number_of_tile] = left;
  return lost;
}

/// All tiles', after update(tile), which may do whatever else a tile needs first.
template <int Dim, class Shape, class Update>
LostPoints move_pass(State<Dim, Shape>& state, Real dt, Update&& update) {
  std::uint32_t outside = no_point, turned_over = no_point;
  const auto tiles = static_cast<std::int64_t>(state.order.tiles().size());
  grow(state.left, state.order.tiles().size());
#pragma omp parallel for schedule(static) reduction(min : outside, turned_over)
  for (std::int64_t k = 0; k < tiles; ++k) {
    const auto tile = static_cast<std::size_t>(k);
    update(tile);
    const LostPoints lost = move_tile(state, tile, dt);
    outside = std::min(outside, lost.outside);
    turned_over = std::min(turned_over, lost.turned_over);
  }
  return {outside, turned_over};
}

} // namespace scarp
