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
  CellOrder<Dim, Shape::width, tile_cells<Number>> order;
  GridState<Dim, Shape> nodal;
  /// Of B-splines, by axis and side: the pairs of CellOrder that the side acts on in this step, see
  /// core/contact_pass.hpp.
  std::array<std::array<std::vector<SidePair>, 2>, Dim> contacts;
  std::vector<std::uint8_t> marks; ///< by node; scratch of it
  /// By tile: whether points have left their cells since the order was last updated.  Empty:
  /// nothing is known of them.
  std::vector<std::uint8_t> left;
  /// Whether the points of a cell have one volumetric strain rate: see core/stress_pass.hpp.
  bool averages_volume = false;
  /// Whether points move with the velocity that strains them, the remapped one: see
  /// core/move_pass.hpp.
  bool moves_with_strain = false;

  State(const Grid& scene_grid, Particles<Dim, Number> points, bool tracks_fraction = false)
      : grid(scene_grid, Shape::layout), half_point(0.5 / scene_grid.points_per_cell),
        particles(std::move(points)), order(grid), nodal(grid, tracks_fraction) {
    if (!tracks_fraction) particles.gap = ColumnOf<Number>();
    particles.for_each_column([](auto& column) { column.shrink_to_fit(); });
  }
  /// Bytes.
  std::size_t memory() const {
    std::size_t bytes =
        particles.memory() + order.memory() + nodal.memory() + bytes_of(marks, left);
    for (const auto& of_axis : contacts) bytes += bytes_of(of_axis[0], of_axis[1]);
    return bytes;
  }

  State(const State&) = delete; // `order` points to `grid`
  State& operator=(const State&) = delete;
};

/// Calls visit(its number) for every tile, on all threads.
template <int Dim, class Shape, class Visit>
void for_each_tile(const State<Dim, Shape>& state, Visit&& visit) {
  const auto tiles = static_cast<std::int64_t>(state.order.tiles().size());
#pragma omp parallel for schedule(static)
  for (std::int64_t tile = 0; tile < tiles; ++tile) visit(static_cast<std::size_t>(tile));
}

/// Calls visit(cell) for the occupied cells of a tile.
template <int Dim, class Shape, class Visit>
void for_each_cell_of(const State<Dim, Shape>& state, std::size_t tile, Visit&& visit) {
  for (std::size_t lane = 0; lane < tile_cells<typename Shape::Number>; ++lane)
    if (const auto cell = state.order.cell(tile, lane); cell.count > 0) visit(cell);
}

/// kg, of the points of a rank with these volumes before loading.
template <int Dim, class T>
[[gnu::always_inline]] inline Pack<T> load_masses(const Particles<Dim, T>& points, std::size_t row,
                                                  const std::type_identity_t<Pack<T>>& V0) {
  return points.m.empty() ? points.density * V0 : load_lanes(&points.m[row]);
}

/// Where the lanes of a tile lie, and which of them have points.
template <int Dim, class Shape> class TileLanes {
  using T = typename Shape::Number;
  using Order = CellOrder<Dim, Shape::width, tile_cells<T>>;
  using Counts = Lanes<std::uint32_t, tile_cells<T>>;

 public:
  using Places = Lanes<Real, tile_cells<T>>;
  [[gnu::always_inline]] TileLanes(const State<Dim, Shape>& state, std::size_t tile)
      : state_(state), tile_(state.order.tiles()[tile]),
        stencil_(state.grid, tile_.along, state.half_point),
        count_(Counts(tile_.count.data(), std::experimental::element_aligned)) {}

  using Rank = typename Order::Rank;

  auto ranks() const { return state_.order.ranks(tile_); }
  /// Lanes with a point of this rank.
  [[gnu::always_inline]] auto filled(const Rank& rank) const {
    return std::experimental::static_simd_cast<Pack<T>>(count_) > static_cast<T>(rank.number);
  }
  /// Rows of a rank with this material; empty ones have material 0.
  [[gnu::always_inline]] auto of_material(const Rank& rank, std::uint8_t material) const {
    const Lanes<std::uint8_t, tile_cells<T>> of_rows(&state_.particles.material[rank.row],
                                                     std::experimental::element_aligned);
    return std::experimental::static_simd_cast<Pack<T>>(of_rows) == static_cast<T>(material);
  }
  const StencilCell<Dim>& stencil() const { return stencil_; } ///< of the first cell

  /// The same for numbers in double precision.
  [[gnu::always_inline]] auto filled_places(const Rank& rank) const {
    return std::experimental::static_simd_cast<Places>(count_) > static_cast<Real>(rank.number);
  }
  /// m, of a rank's points along an axis.
  [[gnu::always_inline]] Places position(const Rank& rank, std::size_t axis) const {
    return Places(&state_.particles.x[axis][rank.row], std::experimental::element_aligned);
  }

  /// Where a rank's points lie in their cells, each component in [0, 1).
  [[gnu::always_inline]] std::array<Pack<T>, Dim> local_position(const Rank& rank) const {
    std::array<Pack<T>, Dim> xi;
    unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
      xi[i] = std::experimental::static_simd_cast<Pack<T>>(in_cells(position(rank, i), i));
    });
    return xi;
  }

  /// Such places (m, of all lanes along an axis) from the lower ends of the lanes' cells, in cells.
  [[gnu::always_inline]] Places in_cells(const Places& x, auto axis) const {
    Places own = state_.grid.scaled(x, axis) - stencil_.corner[axis];
    if constexpr (axis == 0) own -= lane_numbers<Real, tile_cells<T>>();
    return own;
  }

  /// By corner c, a nodal value at node c of each cell.
  [[gnu::always_inline]] auto at_nodes(const ColumnOf<T>& nodes) const {
    return [ from = nodes.data() + tile_.first_node, this ](std::size_t c)
        __attribute__((always_inline)) {
      return load_lanes(from + state_.grid.corner_offset[c]);
    };
  }

 private:
  const State<Dim, Shape>& state_;
  const typename Order::Tile& tile_;
  StencilCell<Dim> stencil_;
  Counts count_;
};

/// Calls visit(run, its number) for every run of active nodes, on all threads.
template <int Dim, class Shape, class Visit>
void for_each_node_run(const State<Dim, Shape>& state, Visit&& visit) {
  const auto n = static_cast<std::int64_t>(state.order.node_runs().size());
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k)
    visit(state.order.node_runs()[static_cast<std::size_t>(k)], static_cast<std::size_t>(k));
}

/// What the points of a cell share in their shape functions.
template <int Dim, class Shape>
StencilCell<Dim> stencil_cell(const State<Dim, Shape>& state, const auto& cell) {
  return StencilCell<Dim>(state.grid, cell.along, state.half_point);
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

/// By corner c, a nodal value at node c of a cell.
template <int Dim, class Shape>
auto at_nodes(const State<Dim, Shape>& state, const auto& cell, const auto& nodes) {
  return [from = nodes.data() + cell.first_node, &state](std::size_t c) {
    return from[state.grid.corner_offset[c]];
  };
}

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
Real cell_mean(const State<Dim, Shape>& state, const auto& cell, Value&& value) {
  Real sum = 0.0, weight = 0.0;
  for (std::size_t k = 0; k < cell.count; ++k) {
    const std::size_t p = cell.row(k);
    sum += state.particles.V0[p] * value(p);
    weight += state.particles.V0[p];
  }
  return sum / weight;
}

} // namespace scarp
