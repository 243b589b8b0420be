// Which rows hold the points of which cell, and which tiles and nodes a step touches.
#pragma once

#include "core/grid_index.hpp"
#include "core/lanes.hpp"
#include "core/particles.hpp"

#include <cstdint>
#include <vector>

namespace scarp {

/// Nodes that a side acts on, with the mean velocity of the side: see GridIndex::side_layers.
struct SidePair {
  int outer, inner;
};

/// The occupied tiles: `tile_cells` cells that follow each other along x, from a multiple of it on.
///
/// A tile owns ranks, which are `tile_cells` rows of Particles that follow each other, each for the
/// cell in its lane; a cell's points fill its ranks from the first on.  So the passes have a cell
/// in each lane of their registers, with the cells' nodes one behind the other in memory; nothing
/// has to be collected from or spread to different places.  The lanes that some cells of a tile do
/// not fill are the price: empty rows, without mass.
///
/// A point that changes cell takes its state along to its new row, and the cell's last point fills
/// the gap.  A tile has ranks of its own, one behind the other, and takes more from among some idle
/// ones as its fullest cell needs them: a pass over ranks in no order takes up to twice as long
/// where the memory is what it waits for.  Once too many are out of order or without points, all
/// are put in order.  Which row is whose depends on the state alone, never on threads.
///
/// What a tile gives nodes is added up in `tile_entries` entries for each line of nodes along x
/// that it reaches; the nodes add up those of all tiles that reach them.
template <int Dim, int width, std::size_t tile_cells> class CellOrder {
 public:
  static constexpr std::size_t lines = static_cast<std::size_t>(power(width, Dim - 1));
  static constexpr std::size_t tile_entries = tile_cells + width - 1;
  static constexpr std::uint32_t none = no_point; ///< no row, tile or run

  struct Tile {
    int index;                  ///< of all tiles of the grid
    int first_node;             ///< lowest node of its first cell
    std::array<int, Dim> along; ///< cells before its first one along each axis
    std::uint32_t row;          ///< the first one of its first rank
    std::uint32_t ranks;        ///< most points in one of its cells
    std::uint32_t home;         ///< ranks that it keeps whether it fills them or not
    std::array<std::uint32_t, tile_cells> count; ///< points in each cell
  };

  /// The ranks of a tile, one after the other.
  class Ranks {
   public:
    struct Rank {
      std::uint32_t number;
      std::size_t row; ///< its first one
    };
    class Iterator {
     public:
      Iterator(const std::uint32_t* next, std::uint32_t row, std::uint32_t number)
          : next_(next), row_(row), number_(number) {}
      Rank operator*() const { return {number_, row_}; }
      Iterator& operator++() {
        row_ = next_[row_ / tile_cells];
        ++number_;
        return *this;
      }
      bool operator!=(const Iterator& other) const { return number_ != other.number_; }

     private:
      const std::uint32_t* next_;
      std::uint32_t row_, number_;
    };

    Ranks(const std::uint32_t* next, const Tile& tile)
        : next_(next), row_(tile.row), count_(tile.ranks) {}
    Iterator begin() const { return {next_, row_, 0}; }
    Iterator end() const { return {next_, none, count_}; }

   private:
    const std::uint32_t* next_;
    std::uint32_t row_, count_;
  };
  using Rank = typename Ranks::Rank;

  /// An occupied cell, for what goes through it point by point.
  struct Cell {
    std::array<int, Dim> along; ///< cells before it along each axis
    int first_node;             ///< its lowest one
    std::size_t entry;          ///< of its first node along x
    Ranks ranks;                ///< of its tile
    std::size_t lane;
    std::size_t count; ///< points

    /// Of its k-th point.
    std::size_t row(std::size_t k) const {
      auto rank = ranks.begin();
      while ((*rank).number < k) ++rank;
      return (*rank).row + lane;
    }
  };

  /// Up to tile_cells active nodes that follow each other along x, and the entries which they add
  /// up: of the tile that begins with them, and the last ones of the tile before it, line by line.
  struct NodeRun {
    int node; ///< the first one
    std::size_t count;
    std::array<std::uint32_t, lines> whole, ends;
  };

  explicit CellOrder(const GridIndex<Dim>& grid) : grid_(&grid) {}

  /// Assigns every point to its cell.  All points must lie in the grid.  `left`, by tile: 0 where
  /// all points are known to lie in their cells still; empty: nothing is known.
  template <class T>
  void update(Particles<Dim, T>& particles, const std::vector<std::uint8_t>& left = {});

  const std::vector<Tile>& tiles() const { return tiles_; }
  Ranks ranks(const Tile& tile) const { return {next_.data(), tile}; }
  /// The cell in a lane of a tile; maybe without points.
  Cell cell(std::size_t tile, std::size_t lane) const;
  /// All occupied cells, tile after tile.
  std::vector<Cell> cells() const;

  /// The first entry of a tile.
  static std::size_t entry(std::size_t tile) { return tile * tile_entries; }
  /// Of all tiles, and of one more that gives nothing: where no tile reaches.
  std::size_t entries() const { return entry(tiles_.size() + 1); }

  const std::vector<NodeRun>& node_runs() const { return runs_; }
  /// Active nodes of a side that acts (GridIndex::acts), in the order of the outer ones.
  const std::vector<SidePair>& side_pairs(std::size_t axis, std::size_t side) const {
    return side_pairs_[axis][side];
  }
  /// The tiles with cells at such a side.
  const std::vector<std::uint32_t>& side_tiles(std::size_t axis, std::size_t side) const {
    return side_tiles_[axis][side];
  }

  /// Bytes kept from step to step.
  std::size_t memory() const {
    std::size_t bytes = bytes_of(tiles_, slot_of_, next_, idle_, runs_, run_of_);
    for (const auto& axis : side_pairs_) bytes += bytes_of(axis[0], axis[1]);
    for (const auto& axis : side_tiles_) bytes += bytes_of(axis[0], axis[1]);
    for (const Leaving& out : leaving_)
      bytes += bytes_of(out.moves, out.points, out.ranks, out.of_tile);
    return bytes;
  }

 private:
  /// A point on its way to another cell.
  struct Move {
    int to_tile; ///< index
    std::uint32_t to_lane;
    std::uint32_t to_row;
  };
  /// What has left the tiles that one thread has looked at.
  struct Leaving {
    std::vector<Move> moves;
    std::vector<std::byte> points;    ///< by move, see Particles::take_out
    std::vector<std::uint32_t> ranks; ///< that nobody fills any more: their first rows
    std::ptrdiff_t unfilled = 0;      ///< change of `unfilled_`
    std::size_t emptied = 0;          ///< tiles
    std::vector<Rank> of_tile;        ///< scratch

    void clear() {
      moves.clear();
      points.clear();
      ranks.clear();
      unfilled = 0;
      emptied = 0;
    }
  };

  static constexpr int lanes = static_cast<int>(tile_cells);

  int tiles_along_x() const { return (grid_->cells[0] - 1) / lanes + 1; }
  int tile_count() const { return grid_->cell_count / grid_->cells[0] * tiles_along_x(); }
  Tile empty_tile(int index) const;
  template <class T> void take_out(std::uint32_t slot, Particles<Dim, T>& particles, Leaving& out);
  void find_row(Move& move);
  std::uint32_t take_rank();
  template <class T> void rebuild(Particles<Dim, T>& particles);
  void find_node_runs();
  void find_sides();
  void find_side_pairs(std::size_t axis, int outer, int inner, std::vector<SidePair>& pairs) const;

  const GridIndex<Dim>* grid_;
  std::vector<Tile> tiles_;
  std::vector<std::uint32_t> slot_of_; ///< in tiles_, of all tiles of the grid; or none
  std::vector<std::uint32_t> next_;    ///< by rank: the first row of its tile's next one
  std::vector<std::uint32_t> idle_;    ///< ranks that no tile has: their first rows
  std::size_t strays_ = 0;             ///< ranks that tiles have taken, not at home
  std::ptrdiff_t unfilled_ = 0;        ///< ranks at home without points
  std::size_t empty_tiles_ = 0;
  std::vector<Leaving> leaving_; ///< by thread; scratch of update()
  std::vector<NodeRun> runs_;
  std::vector<std::uint32_t> run_of_; ///< in runs_, of all runs of the grid; or none
  std::array<std::array<std::vector<SidePair>, 2>, Dim> side_pairs_;
  std::array<std::array<std::vector<std::uint32_t>, 2>, Dim> side_tiles_;
};

} // namespace scarp
