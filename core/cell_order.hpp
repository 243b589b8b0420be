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
/// A tile owns rows of Particles, rank after rank: row + tile_cells * rank + lane is for the cell
/// in that lane, and a cell's points fill its ranks from 0 on.  So the passes have a cell in each
/// lane of their registers, with the cells' nodes one behind the other in memory; nothing has to
/// be collected from or spread to different places.  The ranks that some cells of a tile do not
/// fill are the price: empty rows, without mass.
///
/// A point that changes cell takes its state along to its new row, and the cell's last point fills
/// the gap.  A tile that is full gets rows elsewhere.  Once too many rows are empty, all are put in
/// order.  Which row is whose depends on the state alone, never on threads.
///
/// What a tile gives nodes is added up in `tile_entries` entries for each line of nodes along x
/// that it reaches; the nodes add up those of all tiles that reach them.
template <int Dim, int width, std::size_t tile_cells> class CellOrder {
 public:
  static constexpr std::size_t lines = static_cast<std::size_t>(power(width, Dim - 1));
  static constexpr std::size_t tile_entries = tile_cells + width - 1;

  struct Tile {
    int index;                                   ///< of all tiles of the grid
    int first_node;                              ///< lowest node of its first cell
    std::array<int, Dim> along;                  ///< cells before its first one along each axis
    std::uint32_t row;                           ///< its first one
    std::uint32_t capacity;                      ///< ranks that it has rows for
    std::uint32_t ranks;                         ///< most points in one of its cells
    std::array<std::uint32_t, tile_cells> count; ///< points in each cell
  };

  /// An occupied cell, for what goes through it point by point.
  struct Cell {
    std::array<int, Dim> along; ///< cells before it along each axis
    int first_node;             ///< its lowest one
    std::size_t entry;          ///< of its first node along x
    std::size_t first_row;
    std::size_t count; ///< points

    std::size_t row(std::size_t k) const { return first_row + k * tile_cells; }
  };

  /// Up to tile_cells active nodes that follow each other along x, and the entries which they add
  /// up: of the tile that begins with them, and the last ones of the tile before it, line by line.
  struct NodeRun {
    int node; ///< the first one
    std::size_t count;
    std::array<std::uint32_t, lines> whole, ends;
  };

  explicit CellOrder(const GridIndex<Dim>& grid) : grid_(&grid) {}

  /// Assigns every point to its cell.  All points must lie in the grid.
  template <class T> void update(Particles<Dim, T>& particles);

  const std::vector<Tile>& tiles() const { return tiles_; }
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
    std::size_t bytes = bytes_of(tiles_, slot_of_, runs_, run_of_, free_);
    for (const auto& rows : free_) bytes += bytes_of(rows);
    for (const auto& axis : side_pairs_) bytes += bytes_of(axis[0], axis[1]);
    for (const auto& axis : side_tiles_) bytes += bytes_of(axis[0], axis[1]);
    return bytes;
  }

 private:
  static constexpr std::uint32_t none = no_point;

  /// A point that has left its cell.
  struct Move {
    std::uint32_t slot; ///< of its tile
    std::uint32_t rank;
    std::uint32_t lane;
    int to_tile; ///< index
    std::uint32_t to_lane;
  };

  static constexpr int lanes = static_cast<int>(tile_cells);

  int tiles_along_x() const { return (grid_->cells[0] - 1) / lanes + 1; }
  int tile_count() const { return grid_->cell_count / grid_->cells[0] * tiles_along_x(); }
  Tile empty_tile(int index) const;
  template <class T> std::vector<Move> find_moves(const Particles<Dim, T>& particles) const;
  template <class T> void carry_out(const Move& move, Particles<Dim, T>& particles);
  template <class T> void grow(Tile& tile, Particles<Dim, T>& particles);
  template <class T> void rebuild(Particles<Dim, T>& particles);
  void find_node_runs();
  void find_sides();
  void find_side_pairs(std::size_t axis, int outer, int inner, std::vector<SidePair>& pairs) const;

  const GridIndex<Dim>* grid_;
  std::vector<Tile> tiles_;
  std::vector<std::uint32_t> slot_of_;           ///< in tiles_, of all tiles of the grid; or none
  std::size_t ranks_ = 0;                        ///< of all tiles
  std::vector<std::vector<std::uint32_t>> free_; ///< rows that a tile has left, by its capacity
  std::vector<NodeRun> runs_;
  std::vector<std::uint32_t> run_of_; ///< in runs_, of all runs of the grid; or none
  std::array<std::array<std::vector<SidePair>, 2>, Dim> side_pairs_;
  std::array<std::array<std::vector<std::uint32_t>, 2>, Dim> side_tiles_;
};

} // namespace scarp
