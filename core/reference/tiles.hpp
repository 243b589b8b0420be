// What a cell gives its nodes, added to the sums of its tile, a node at a time.
#pragma once

#include "core/state.hpp"

namespace scarp::reference {

/// What the points of one cell give its corners.
template <int Dim, int corners> struct CellTile {
  using AtNodes = std::array<Real, corners>;
  AtNodes m;                   ///< kg
  AtNodes V0;                  ///< m3, of the unloaded material
  std::array<AtNodes, Dim> mv; ///< kg m/s
  std::array<AtNodes, Dim> f;  ///< N, internal
};

template <int Dim, class Shape>
void clear_tile(std::size_t tile, typename TileSums<Dim, Shape>::Lines& sums) {
  using Order = CellOrder<Dim, Shape::width, tile_cells<typename Shape::Number>>;
  for (auto& line : sums) std::fill_n(&line[Order::entry(tile)], Order::tile_entries, 0.0);
}

template <int Dim, class Shape>
void add_to_tile(
    const typename CellOrder<Dim, Shape::width, tile_cells<typename Shape::Number>>::Cell& cell,
    const std::array<Real, Shape::nodes>& of_cell, typename TileSums<Dim, Shape>::Lines& to) {
  for (std::size_t c = 0; c < Shape::nodes; ++c)
    to[c / Shape::width][cell.entry + c % Shape::width] += of_cell[c];
}

} // namespace scarp::reference
