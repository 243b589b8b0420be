// Everything that changes during a run, for the passes over cells and nodes.
#pragma once

#include "core/cell_order.hpp"
#include "core/grid_index.hpp"
#include "core/lanes.hpp"
#include "core/linear_shape.hpp"
#include "core/nodes.hpp"
#include "core/particles.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace scarp {

template <int Dim, class ShapeFunctions = LinearShape<Dim>> struct State {
  using Shape = ShapeFunctions;
  using Number = typename Shape::Number;
  static constexpr std::size_t corners = Shape::nodes;

  GridIndex<Dim> grid;
  Real half_point; ///< half the length of a point, in cells
  Particles<Dim, Number> particles;
  CellOrder<Dim, Shape::nodes> order;
  GridState<Dim, Shape> nodal;
  /// Of B-splines, by axis and side: the pairs of CellOrder that the side acts on in this step, see
  /// core/contact_pass.hpp.
  std::array<std::array<std::vector<typename CellOrder<Dim, Shape::nodes>::SidePair>, 2>, Dim>
      contacts;
  /// Whether the points of a cell have one volumetric strain rate: see core/stress_pass.hpp.
  bool averages_volume = false;
  /// Whether points move with the velocity that strains them, the remapped one: see
  /// core/stress_pass.hpp.
  bool moves_with_strain = false;

  State(const Grid& scene_grid, Particles<Dim, Number> points, bool tracks_fraction = false)
      : grid(scene_grid, Shape::layout), half_point(0.5 / scene_grid.points_per_cell),
        particles(std::move(points)), order(grid), nodal(grid, tracks_fraction) {
    if (!tracks_fraction) particles.gap = ColumnOf<Number>();
    particles.for_each_column([](auto& column) { column.shrink_to_fit(); });
  }
  /// Bytes.
  std::size_t memory() const {
    std::size_t bytes = particles.memory() + order.memory() + nodal.memory();
    for (const auto& of_axis : contacts) bytes += bytes_of(of_axis[0], of_axis[1]);
    return bytes;
  }

  State(const State&) = delete; // `order` points to `grid`
  State& operator=(const State&) = delete;
};

/// Occupied cells that a thread works on together, so that registers are full of their points.
struct CellBlock {
  std::size_t first_slot, end_slot;
  const std::uint32_t* rows; ///< of Particles
  std::size_t size;          ///< number of rows

  template <class T> [[gnu::always_inline]] RowPack<T> pack(std::size_t k) const {
    return {rows + k, std::min(RowPack<T>::capacity, size - k)};
  }
};

template <int Dim, class Shape> std::int64_t block_count(const State<Dim, Shape>& state) {
  constexpr std::size_t cells = CellOrder<Dim, Shape::nodes>::block_cells;
  return static_cast<std::int64_t>((state.order.cells() + cells - 1) / cells);
}

template <int Dim, class Shape>
CellBlock cell_block(const State<Dim, Shape>& state, std::int64_t index) {
  constexpr std::size_t cells = CellOrder<Dim, Shape::nodes>::block_cells;
  const std::size_t first = static_cast<std::size_t>(index) * cells;
  const std::size_t end = std::min(first + cells, state.order.cells());
  const std::size_t begin = state.order.begin(first);
  return {first, end, state.order.rows() + begin, state.order.begin(end) - begin};
}

/// Calls visit(slot) for every occupied cell, on all threads, those of a block in order on one.
template <int Dim, class Shape, class Visit>
void for_each_cell(const State<Dim, Shape>& state, Visit&& visit) {
  const std::int64_t blocks = block_count(state);
#pragma omp parallel for schedule(static)
  for (std::int64_t b = 0; b < blocks; ++b) {
    const CellBlock block = cell_block(state, b);
    for (std::size_t slot = block.first_slot; slot < block.end_slot; ++slot) visit(slot);
  }
}

/// Where the rows of a pack lie in their cells, each component in [0, 1).
template <int Dim, class Shape, class T>
[[gnu::always_inline]] inline std::array<Pack<T>, Dim>
local_position(const State<Dim, Shape>& state, const RowPack<T>& rows) {
  std::array<Pack<T>, Dim> xi;
  for (std::size_t i = 0; i < Dim; ++i)
    xi[i] = rows.map(state.particles.x[i], [&](const auto& x) {
      const auto scaled = state.grid.scaled(x, i);
      return scaled - floor(scaled);
    });
  return xi;
}

/// Calls visit(run, its number) for every run of active nodes, on all threads.
template <int Dim, class Shape, class Visit>
void for_each_node_run(const State<Dim, Shape>& state, Visit&& visit) {
  const auto n = static_cast<std::int64_t>(state.order.node_runs().size());
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k)
    visit(state.order.node_runs()[static_cast<std::size_t>(k)], static_cast<std::size_t>(k));
}

/// What the points of an occupied cell share in their shape functions.
template <int Dim, class Shape>
StencilCell<Dim> stencil_cell(const State<Dim, Shape>& state, std::size_t slot) {
  return StencilCell<Dim>(state.grid, state.order.place(slot).along, state.half_point);
}

/// Where row p lies in its cell, each component in [0, 1).
template <int Dim, class Shape>
[[gnu::always_inline]] inline Vec<Dim>
local_position(const State<Dim, Shape>& state, const std::type_identity_t<StencilCell<Dim>>& cell,
               std::size_t p) {
  Vec<Dim> xi;
  for (std::size_t i = 0; i < Dim; ++i)
    xi[i] = state.grid.scaled(state.particles.x[i][p], i) - cell.corner[i];
  return xi;
}

/// Finds the values of the nodes that a cell reaches.
template <int Dim, class Shape> class Corners {
 public:
  explicit Corners(const State<Dim, Shape>& state) {
    for (std::size_t line = 0; line < lines_.size(); ++line)
      lines_[line] = state.grid.corner_offset[line * Shape::width];
  }

  /// By corner, of the cell with this lowest node.
  [[gnu::always_inline]] auto of(const auto& nodes, int first_node) const {
    return [from = nodes.data() + first_node, this](std::size_t corner) {
      return from[lines_[corner / Shape::width] +
                  static_cast<std::ptrdiff_t>(corner % Shape::width)];
    };
  }

 private:
  std::array<std::ptrdiff_t, Shape::nodes / Shape::width> lines_;
};

/// Shape functions at row p.
template <int Dim, class Shape>
[[gnu::always_inline]] inline Shape shape_at(const State<Dim, Shape>& state,
                                             const std::type_identity_t<StencilCell<Dim>>& cell,
                                             std::size_t p) {
  return Shape(local_position(state, cell, p), cell);
}

/// Pa, of the Kirchhoff stress.
template <int Dim, class T> Real mean_stress(const Particles<Dim, T>& points, std::size_t p) {
  return (points.tau[0][p] + points.tau[1][p] + points.tau[2][p]) * (1.0 / 3.0);
}

/// Mean of a value of the rows in a cell, with their volumes before loading as weights.
template <int Dim, class Shape, class Value>
Real cell_mean(const State<Dim, Shape>& state, std::size_t slot, Value&& value) {
  Real sum = 0.0, weight = 0.0;
  for (std::size_t k = state.order.begin(slot); k < state.order.end(slot); ++k) {
    const std::size_t p = state.order.row(k);
    sum += state.particles.V0[p] * value(p);
    weight += state.particles.V0[p];
  }
  return sum / weight;
}

} // namespace scarp
