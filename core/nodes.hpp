// State of the background grid's nodes and what the passes over cells leave for them.
#pragma once

#include "core/particles.hpp"
#include "core/stencil.hpp"

#include <cmath>
#include <vector>

namespace scarp {

/// What the points of a block of cells give the nodes, added up along its strips (CellOrder): for
/// each of the lines of nodes that a strip reaches, one number an entry, that is for every node
/// along x.  The nodes add up the strips' lines in a fixed order, so no two threads ever write to
/// the same place.
template <int Dim, class Shape> struct StripSums {
  using Column = ColumnOf<typename Shape::Number>;
  static constexpr std::size_t lines = Shape::nodes / Shape::width;
  using Lines = std::array<Column, lines>;

  Lines m;                   ///< kg
  Lines V0;                  ///< m3, of the unloaded material; only if it is tracked
  std::array<Lines, Dim> mv; ///< kg m/s
  std::array<Lines, Dim> f;  ///< N, internal

  void resize(std::size_t entries, bool with_volume) {
    const auto resize_lines = [entries](Lines& all) {
      for (Column& line : all) line.resize(entries);
    };
    resize_lines(m);
    if (with_volume) resize_lines(V0);
    for (Lines& component : mv) resize_lines(component);
    for (Lines& component : f) resize_lines(component);
  }
};

/// One number for each node of a strip's cells, cell after cell.
template <int Dim, class Shape> class StripSum {
 public:
  using Number = typename Shape::Number;

  /// Adds a cell's; after its `last` cell the strip is complete.
  [[gnu::always_inline]] void add(const NodeLanes<Shape::nodes, Number>& cell,
                                  typename StripSums<Dim, Shape>::Lines& to, std::size_t entry,
                                  bool last) {
    const std::array<Number, Shape::nodes> sums = cell.values();
    for (std::size_t line = 0; line < lines; ++line) {
      to[line][entry] = carry_[0][line] + sums[line];
      for (std::size_t k = 1; k < columns; ++k)
        carry_[k - 1][line] = carry_[k][line] + sums[k * lines + line];
      carry_[columns - 1][line] = sums[columns * lines + line];
      if (!last) continue;
      for (std::size_t k = 0; k < columns; ++k) {
        to[line][entry + 1 + k] = carry_[k][line];
        carry_[k][line] = 0;
      }
    }
  }

 private:
  static constexpr std::size_t lines = StripSums<Dim, Shape>::lines;
  static constexpr std::size_t columns = Shape::width - 1; ///< that a cell shares with the next
  std::array<std::array<Number, lines>, columns> carry_ = {};
};

/// By node index; only active nodes are meaningful.
template <int Dim, class T = Real> struct Nodes {
  using Column = ColumnOf<T>;
  Column m; ///< kg
  /// 1/kg, of what moves together: the node and its images (core/walls.hpp); 0 without mass.
  Column inv_m;
  std::array<Column, Dim> f;  ///< N, with gravity
  std::array<Column, Dim> v;  ///< m/s, after the latest constraint
  std::array<Column, Dim> dv; ///< m/s, change by the forces of this step
  /// N, of local damping in this step; empty without it, and if no one asks (core/node_pass.hpp)
  std::array<Column, Dim> drag;
  Column fraction; ///< -, see GridState::tracks_fraction
};

template <int Dim, class Shape> struct GridState {
  StripSums<Dim, Shape> sums;
  Nodes<Dim, typename Shape::Number> nodes;
  Column damped;     ///< J, taken in this step by local damping, by run of nodes
  Real rubbed = 0.0; ///< J, taken in this step by friction on walls
  /// By axis, side and pair (CellOrder::side_pairs): what friction has done in this step.
  struct Rub {
    Vec<Dim> dv = {};   ///< m/s, to the velocity on the side, along it
    bool stuck = false; ///< whether it has stopped it
    Real taken = 0.0;   ///< J, that it takes with the latest velocities
  };
  std::array<std::array<std::vector<Rub>, 2>, Dim> rubs;

  /// Whether nodes keep the part of their volume that the unloaded material of the points fills.
  bool tracks_fraction;
  Column volume; ///< m3, by node: what belongs to it of the cells around it

  /// Bytes.
  std::size_t memory() const {
    std::size_t bytes = bytes_of(nodes.m, nodes.inv_m, nodes.fraction, damped, volume);
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
    const auto n = static_cast<std::size_t>(grid.node_count);
    nodes.m.resize(n);
    nodes.inv_m.resize(n);
    for (std::size_t i = 0; i < Dim; ++i) {
      nodes.f[i].resize(n);
      nodes.v[i].resize(n);
      nodes.dv[i].resize(n);
    }
    if (!tracks_fraction) return;
    nodes.fraction.resize(n);
    volume.assign(n, 0.0);
    for (int index = 0; index < grid.cell_count; ++index) {
      for (std::size_t c = 0; c < Shape::nodes; ++c) {
        const auto k = Shape::places(c);
        Real share = std::pow(grid.h, Dim);
        for (std::size_t a = 0; a < Dim; ++a) share *= Shape::shares[k[a]];
        volume[static_cast<std::size_t>(grid.first_node(index) + grid.corner_offset[c])] += share;
      }
    }
  }
};

} // namespace scarp
