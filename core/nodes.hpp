// State of the background grid's nodes and what the passes over cells leave for them.
#pragma once

#include "core/cell_order.hpp"
#include "core/stencil.hpp"

#include <cmath>
#include <vector>

namespace scarp {

/// What the points of a tile of cells give the nodes (CellOrder): for each of the lines of nodes
/// that it reaches, one number an entry, that is for every node along x.  The nodes add up the
/// tiles' entries in a fixed order, so no two threads ever write to the same place.
template <int Dim, class Shape> struct TileSums {
  using T = typename Shape::Number;
  using Order = CellOrder<Dim, Shape::width, tile_cells<T>>;
  using Lines = std::array<ColumnOf<T>, Order::lines>;
  using OfCells = std::array<Pack<T>, Shape::nodes>; ///< by corner, a number for each cell

  Lines m;                   ///< kg
  Lines V0;                  ///< m3, of the unloaded material; only if it is tracked
  std::array<Lines, Dim> mv; ///< kg m/s
  std::array<Lines, Dim> f;  ///< N, internal

  [[gnu::always_inline]] static void clear(OfCells& sums) {
    repeated<Order::lines>([&](std::size_t line) __attribute__((always_inline)) {
      unrolled<Shape::width>([&](auto k) __attribute__((always_inline)) {
        sums[line * Shape::width + k] = T(0);
      });
    });
  }

  /// For the tiles of the order; what gives nothing is 0.
  void resize(const Order& order, bool with_volume) {
    const auto resize_lines = [&order](Lines& all) {
      for (auto& line : all) {
        grow(line, order.entries());
        std::fill(line.end() - Order::tile_entries, line.end(), T(0));
      }
    };
    resize_lines(m);
    if (with_volume) resize_lines(V0);
    for (Lines& component : mv) resize_lines(component);
    for (Lines& component : f) resize_lines(component);
  }

  /// Sets a tile's entries, each to the sum over the cells that share the node.
  [[gnu::always_inline]] static void add_up(const OfCells& of_cells, Lines& to, std::size_t tile) {
    repeated<Order::lines>([&](std::size_t line) __attribute__((always_inline)) {
      Pack<T> whole = of_cells[line * Shape::width], ends = T(0);
      unrolled<Shape::width - 1>([&](auto k) __attribute__((always_inline)) {
        const Pack<T>& values = of_cells[line * Shape::width + k + 1];
        whole += moved_up<k + 1>(values, Pack<T>(T(0)));
        ends += moved_up<k + 1>(Pack<T>(T(0)), values);
      });
      T* entries = &to[line][Order::entry(tile)];
      store_lanes(whole, entries);
      unrolled<Shape::width - 1>([&](auto k) { entries[tile_cells<T> + k] = ends[k]; });
    });
  }
};

/// By node index, and room for the nodes of lanes beyond the grid's end; only active nodes are
/// meaningful.
template <int Dim, class T = Real> struct Nodes {
  using Column = ColumnOf<T>;
  Column m; ///< kg
  /// 1/kg, of what moves together: the node and its images (core/walls.hpp); 0 without mass.
  Column inv_m;
  std::array<Column, Dim> f; ///< N, with gravity; empty where no sides exchange them
  std::array<Column, Dim> v; ///< m/s, after the latest constraint
  /// m/s, change by the forces of this step; with MUSL from the remapping on: v before it
  std::array<Column, Dim> dv;
  /// N, of local damping in this step; empty without it, and if no one asks (core/node_pass.hpp)
  std::array<Column, Dim> drag;
  Column fraction; ///< -, see GridState::tracks_fraction
};

template <int Dim, class Shape> struct GridState {
  TileSums<Dim, Shape> sums;
  Nodes<Dim, typename Shape::Number> nodes;
  bool remapped = false; ///< whether MUSL has mapped the points' new momenta in this step
  Column damped;         ///< J, taken in this step by local damping, by run of nodes
  Real rubbed = 0.0;     ///< J, taken in this step by friction on walls
  /// By axis, side and pair (CellOrder::side_pairs): what friction has done in this step.
  struct Rub {
    Vec<Dim> dv = {};     ///< m/s, to the velocity on the side, along it
    bool stuck = false;   ///< whether it has stopped it
    bool pressed = false; ///< whether the side has stopped motion into it
    Real taken = 0.0;     ///< J, that it takes with the latest velocities
  };
  std::array<std::array<std::vector<Rub>, 2>, Dim> rubs;

  /// Whether nodes keep the part of their volume that the unloaded material of the points fills.
  bool tracks_fraction;
  /// m, by axis and node along it; a node's volume, what belongs to it of the cells around it, is
  /// their product.
  std::array<ColumnOf<typename Shape::Number>, Dim> widths;

  /// Bytes.
  std::size_t memory() const {
    std::size_t bytes = bytes_of(nodes.m, nodes.inv_m, nodes.fraction, damped);
    for (const auto* columns : {&nodes.f, &nodes.v, &nodes.dv, &nodes.drag})
      for (const auto& column : *columns) bytes += bytes_of(column);
    const auto add_lines = [&bytes](const auto& lines) {
      for (const auto& line : lines) bytes += bytes_of(line);
    };
    for (const auto& of_axis : rubs) add_lines(of_axis);
    add_lines(sums.m);
    add_lines(sums.V0);
    for (std::size_t i = 0; i < Dim; ++i) {
      add_lines(sums.mv[i]);
      add_lines(sums.f[i]);
    }
    return bytes;
  }

  GridState(const GridIndex<Dim>& grid, bool with_fraction) : tracks_fraction(with_fraction) {
    const std::size_t n =
        static_cast<std::size_t>(grid.node_count) + tile_cells<typename Shape::Number>;
    nodes.m.resize(n);
    nodes.inv_m.resize(n);
    for (std::size_t i = 0; i < Dim; ++i) {
      nodes.v[i].resize(n);
      nodes.dv[i].resize(n);
    }
    if (!tracks_fraction) return;
    nodes.fraction.resize(n);
    for (std::size_t a = 0; a < Dim; ++a) {
      const auto along = static_cast<std::size_t>(grid.nodes[a]);
      widths[a].assign(along + tile_cells<typename Shape::Number>, 0.0);
      for (std::size_t cell = 0; cell + Shape::width <= along; ++cell)
        for (std::size_t k = 0; k < Shape::width; ++k)
          widths[a][cell + k] += static_cast<typename Shape::Number>(grid.h * Shape::shares[k]);
    }
  }
};

} // namespace scarp
