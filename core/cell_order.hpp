// Which points lie in which cell, and which cells and nodes a step touches.
#pragma once

#include "core/grid_index.hpp"
#include "core/particles.hpp"

#include <cstdint>
#include <tuple>
#include <vector>

namespace scarp {

/// The occupied cells in ascending order, each with its rows of Particles, and the nodes around
/// them.
///
/// `rows` is brought up to date whenever a point has changed cell; the columns themselves are put
/// into that order only once enough points have moved (`reorder_part`), since copying all state
/// every step costs more than it saves.  Order depends on the state alone, never on threads.
///
/// Cells are worked on in blocks of `block_cells`.  Within a block, occupied cells that follow each
/// other along x are a strip; the cells of a strip share nodes, and what they give these is added
/// up in the strip's entries, one for every node along x.
template <int Dim, int corners = 1 << Dim> class CellOrder {
 public:
  static constexpr std::size_t block_cells = 32;

  /// Where an occupied cell lies.
  struct Place {
    int first_node;             ///< its lowest node
    std::uint32_t entry;        ///< of its first node along x
    std::array<int, Dim> along; ///< cells before it along each axis
  };
  /// Some entries of a strip and the nodes they belong to.
  struct Part {
    int node;            ///< the first one
    std::uint32_t entry; ///< the first one
    std::uint32_t line;  ///< of the lines of nodes that a cell reaches
    std::uint32_t count;
  };
  /// Active nodes that follow each other along x, and the parts of strips that they add up.
  struct NodeRun {
    static constexpr std::size_t most = 64;
    int node; ///< the first one
    std::size_t count;
    std::size_t first_part, end_part;
  };

  explicit CellOrder(const GridIndex<Dim>& grid)
      : grid_(&grid), count_(static_cast<std::size_t>(grid.cell_count) + 1) {}

  /// Assigns every point to its cell.  All points must lie in the grid.
  template <class T> void update(Particles<Dim, T>& particles);

  std::size_t cells() const { return occupied_.size(); }
  int cell(std::size_t slot) const { return occupied_[slot]; }
  const Place& place(std::size_t slot) const { return places_[slot]; }
  std::size_t begin(std::size_t slot) const { return begin_[slot]; }
  std::size_t end(std::size_t slot) const { return begin_[slot + 1]; }
  std::uint32_t row(std::size_t k) const { return rows_[k]; }
  const std::uint32_t* rows() const { return rows_.data(); }

  /// Whether the next cell goes on with this one's strip.
  bool strip_goes_on(std::size_t slot) const {
    return places_[slot + 1].entry == places_[slot].entry + 1;
  }
  std::size_t entries() const { return places_.back().entry; }

  /// Active nodes that a side acts on, as pairs with the mean velocity of the side: see
  /// GridIndex::side_layers.
  struct SidePair {
    int outer, inner;
  };

  const std::vector<NodeRun>& node_runs() const { return runs_; }
  const Part& part(std::size_t k) const { return parts_[k]; }
  /// Only of sides that act (GridIndex::acts).
  const std::vector<SidePair>& side_pairs(std::size_t axis, std::size_t side) const {
    return side_pairs_[axis][side];
  }

  /// Bytes kept from step to step.
  std::size_t memory() const {
    const std::size_t spare =
        std::apply([](const auto&... columns) { return bytes_of(columns...); }, spare_);
    return spare + bytes_of(cell_of_, count_, occupied_, previous_, places_, begin_,
                            previous_begin_, rows_, previous_rows_, parts_, runs_);
  }

 private:
  static constexpr double reorder_part = 0.01;

  struct Move {
    int to; ///< cell
    std::uint32_t row;
    int from;
    auto operator<=>(const Move&) const = default;
  };

  std::vector<Move> find_moves(const std::array<Column, Dim>& x);
  void count_points();
  void follow(const std::vector<Move>& moves);
  void find_places();
  void find_parts();
  void find_node_runs();
  void find_side_pairs();
  void find_side_pairs(std::size_t axis, int outer, int inner, std::vector<SidePair>& pairs) const;
  template <class T> void reorder(Particles<Dim, T>& particles);

  const GridIndex<Dim>* grid_;
  std::vector<int> cell_of_;         ///< of each row
  std::vector<std::uint32_t> count_; ///< scratch of the counting sort
  std::vector<int> occupied_, previous_;
  std::vector<Place> places_; ///< by slot, and an end
  std::vector<std::uint32_t> begin_, previous_begin_;
  std::vector<std::uint32_t> rows_, previous_rows_;
  std::vector<Part> parts_; ///< by first node
  std::vector<NodeRun> runs_;
  std::array<std::array<std::vector<SidePair>, 2>, Dim> side_pairs_;
  /// A column of each type, into which the next one is put in order.
  std::tuple<Column, ColumnOf<float>, std::vector<std::uint32_t>, std::vector<std::uint8_t>,
             std::vector<int>>
      spare_;
  std::size_t moved_ = 0; ///< cell changes since the columns were last put into order
};

} // namespace scarp
