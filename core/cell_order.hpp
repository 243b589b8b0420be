// Which points lie in which cell, and which cells and nodes a step touches.
#pragma once

#include "core/grid_index.hpp"
#include "core/particles.hpp"

#include <cstdint>
#include <vector>

namespace scarp {

/// The occupied cells in ascending order, each with its rows of Particles, and the nodes around
/// them.
///
/// `rows` is brought up to date whenever a point has changed cell; the columns themselves are put
/// into that order only once enough points have moved (`reorder_part`), since copying all state
/// every step costs more than it saves.  Order depends on the state alone, never on threads.
template <int Dim, int corners = 1 << Dim> class CellOrder {
 public:
  struct Node {
    int index;                     ///< in the grid
    std::array<int, corners> slot; ///< occupied cell of which this node is corner c, or -1
  };
  /// Where an occupied cell lies.
  struct Place {
    int first_node;             ///< its lowest node
    std::array<int, Dim> along; ///< cells before it along each axis
  };

  explicit CellOrder(const GridIndex<Dim>& grid)
      : grid_(&grid), count_(static_cast<std::size_t>(grid.cell_count) + 1),
        slot_(static_cast<std::size_t>(grid.node_count + grid.reach()), -1) {}

  /// Assigns every point to its cell.  All points must lie in the grid.
  void update(Particles<Dim>& particles);

  std::size_t cells() const { return occupied_.size(); }
  int cell(std::size_t slot) const { return occupied_[slot]; }
  const Place& place(std::size_t slot) const { return places_[slot]; }
  std::size_t begin(std::size_t slot) const { return begin_[slot]; }
  std::size_t end(std::size_t slot) const { return begin_[slot + 1]; }
  std::uint32_t row(std::size_t k) const { return rows_[k]; }
  const std::uint32_t* rows() const { return rows_.data(); }

  const std::vector<Node>& nodes() const { return nodes_; }

  /// Bytes kept from step to step.
  std::size_t memory() const {
    return bytes_of(cell_of_, count_, slot_, occupied_, previous_, places_, begin_, previous_begin_,
                    rows_, previous_rows_, nodes_);
  }

 private:
  static constexpr double reorder_part = 0.05;

  struct Move {
    int to; ///< cell
    std::uint32_t row;
    int from;
    auto operator<=>(const Move&) const = default;
  };

  std::vector<Move> find_moves(const Particles<Dim>& particles);
  void count_points();
  void follow(const std::vector<Move>& moves);
  void find_places();
  void find_nodes();
  void reorder(Particles<Dim>& particles);

  const GridIndex<Dim>* grid_;
  std::vector<int> cell_of_;         ///< of each row
  std::vector<std::uint32_t> count_; ///< scratch of the counting sort
  std::vector<int> slot_;            ///< by lowest node of a cell, padded: occupied slot or -1
  std::vector<int> occupied_, previous_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> begin_, previous_begin_;
  std::vector<std::uint32_t> rows_, previous_rows_;
  std::vector<Node> nodes_;
  std::size_t moved_ = 0; ///< cell changes since the columns were last put into order
};

} // namespace scarp
