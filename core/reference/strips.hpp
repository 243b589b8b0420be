// What a cell gives its nodes, added to the sums of its strip, a node at a time.
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

/// Entries that the strip's earlier cells have not reached are set, the others are added to.
template <class Shape, int Dim>
void add_to_strip(const State<Dim, Shape>& state, std::size_t slot,
                  const std::array<Real, Shape::nodes>& of_cell,
                  typename StripSums<Dim, Shape>::Lines& to) {
  constexpr std::size_t block_cells = CellOrder<Dim, Shape::nodes>::block_cells;
  const bool begins = slot % block_cells == 0 || !state.order.strip_goes_on(slot - 1);
  for (std::size_t c = 0; c < Shape::nodes; ++c) {
    const std::size_t along = c % Shape::width;
    Real& sum = to[c / Shape::width][state.order.place(slot).entry + along];
    sum = begins || along + 1 == Shape::width ? of_cell[c] : sum + of_cell[c];
  }
}

} // namespace scarp::reference
