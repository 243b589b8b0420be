#include "core/cell_order.hpp"

#include <algorithm>
#include <omp.h>

namespace scarp {

template <int Dim, int width, std::size_t tile_cells>
template <class T>
void CellOrder<Dim, width, tile_cells>::update(Particles<Dim, T>& particles) {
  if (tiles_.empty()) return rebuild(particles);
  const std::vector<Move> moves = find_moves(particles);
  const std::size_t before = tiles_.size();
  for (const Move& move : moves) carry_out(move, particles);
  // A quarter of all rows, and some for scenes that are small.
  if (particles.rows() > (ranks_ + ranks_ / 4 + 16) * tile_cells) return rebuild(particles);
  if (tiles_.size() == before) return;
  find_node_runs();
  find_sides();
}

template <int Dim, int width, std::size_t tile_cells>
auto CellOrder<Dim, width, tile_cells>::cell(std::size_t tile, std::size_t lane) const -> Cell {
  const Tile& in = tiles_[tile];
  Cell cell = {in.along, in.first_node + static_cast<int>(lane), entry(tile) + lane, in.row + lane,
               in.count[lane]};
  cell.along[0] += static_cast<int>(lane);
  return cell;
}

template <int Dim, int width, std::size_t tile_cells>
auto CellOrder<Dim, width, tile_cells>::cells() const -> std::vector<Cell> {
  std::vector<Cell> occupied;
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile)
    for (std::size_t lane = 0; lane < tile_cells; ++lane)
      if (tiles_[tile].count[lane] > 0) occupied.push_back(cell(tile, lane));
  return occupied;
}

template <int Dim, int width, std::size_t tile_cells>
auto CellOrder<Dim, width, tile_cells>::empty_tile(int index) const -> Tile {
  Tile tile = {};
  tile.index = index;
  int rest = index / tiles_along_x(); // of rows of cells
  tile.along[0] = index % tiles_along_x() * lanes;
  for (std::size_t i = 1; i < Dim; rest /= grid_->cells[i], ++i)
    tile.along[i] = rest % grid_->cells[i];
  tile.first_node = grid_->first_node(tile.along);
  return tile;
}

/// Tile by tile, from the last rank of each on: so that a move changes no later one's rank.
template <int Dim, int width, std::size_t tile_cells>
template <class T>
auto CellOrder<Dim, width, tile_cells>::find_moves(const Particles<Dim, T>& particles) const
    -> std::vector<Move> {
  std::vector<std::vector<Move>> of_thread(static_cast<std::size_t>(omp_get_max_threads()));
  const auto n = static_cast<std::int64_t>(tiles_.size());
#pragma omp parallel
  {
    std::vector<Move>& own = of_thread[static_cast<std::size_t>(omp_get_thread_num())];
    using Places = Lanes<Real, tile_cells>;
    const auto lane_number = lane_numbers<Real, tile_cells>();
#pragma omp for schedule(static)
    for (std::int64_t k = 0; k < n; ++k) {
      const auto slot = static_cast<std::uint32_t>(k);
      const Tile& tile = tiles_[slot];
      const Places count([&](auto lane) { return static_cast<Real>(tile.count[lane]); });
      for (std::uint32_t rank = tile.ranks; rank-- > 0;) {
        const std::size_t row = tile.row + rank * tile_cells;
        auto left = count < 0.0;
        for (std::size_t i = 0; i < Dim; ++i) {
          Places xi =
              grid_->scaled(Places(&particles.x[i][row], std::experimental::element_aligned), i) -
              static_cast<Real>(tile.along[i]);
          if (i == 0) xi -= lane_number;
          left = left || xi < 0.0 || xi >= 1.0;
        }
        left = left && count > static_cast<Real>(rank);
        if (none_of(left)) continue;
        for (std::uint32_t lane = 0; lane < tile_cells; ++lane) {
          if (!left[lane]) continue;
          const auto to = grid_->along(grid_->cell_of(particles.position(row + lane)));
          const int cell_row = grid_->row_of(to);
          own.push_back({slot, rank, lane, cell_row * tiles_along_x() + to[0] / lanes,
                         static_cast<std::uint32_t>(to[0] % lanes)});
        }
      }
    }
  }
  std::vector<Move> moves;
  for (const std::vector<Move>& own : of_thread) moves.insert(moves.end(), own.begin(), own.end());
  return moves;
}

template <int Dim, int width, std::size_t tile_cells>
template <class T>
void CellOrder<Dim, width, tile_cells>::carry_out(const Move& move, Particles<Dim, T>& particles) {
  std::uint32_t& slot = slot_of_[static_cast<std::size_t>(move.to_tile)];
  if (slot == none) {
    slot = static_cast<std::uint32_t>(tiles_.size());
    tiles_.push_back(empty_tile(move.to_tile));
  }
  const auto row = [](const Tile& tile, std::uint32_t rank, std::uint32_t lane) {
    return tile.row + rank * tile_cells + lane;
  };

  Tile& to = tiles_[slot];
  const std::uint32_t place = to.count[move.to_lane];
  if (place == to.capacity) grow(to, particles);
  Tile& from = tiles_[move.slot];
  particles.move_rows(row(from, move.rank, move.lane), row(to, place, move.to_lane), 1);
  ++to.count[move.to_lane];
  const std::uint32_t last = --from.count[move.lane];
  if (move.rank != last)
    particles.move_rows(row(from, last, move.lane), row(from, move.rank, move.lane), 1);

  for (Tile* tile : {&to, &from}) {
    ranks_ -= tile->ranks;
    tile->ranks = *std::ranges::max_element(tile->count);
    ranks_ += tile->ranks;
  }
}

/// By one rank.
template <int Dim, int width, std::size_t tile_cells>
template <class T>
void CellOrder<Dim, width, tile_cells>::grow(Tile& tile, Particles<Dim, T>& particles) {
  const std::uint32_t capacity = tile.capacity + 1;
  if (free_.size() <= capacity) free_.resize(capacity + 1);
  auto row = static_cast<std::uint32_t>(particles.rows());
  if (free_[capacity].empty()) {
    particles.resize(row + capacity * tile_cells);
  } else {
    row = free_[capacity].back();
    free_[capacity].pop_back();
  }
  if (tile.capacity > 0) {
    particles.move_rows(tile.row, row, tile.capacity * tile_cells);
    free_[tile.capacity].push_back(tile.row);
  }
  tile.row = row;
  tile.capacity = capacity;
}

/// Tiles in the order of the grid, their rows too, with as many ranks as they need.
template <int Dim, int width, std::size_t tile_cells>
template <class T>
void CellOrder<Dim, width, tile_cells>::rebuild(Particles<Dim, T>& particles) {
  const std::size_t rows = particles.rows();
  std::vector<std::uint32_t> row(rows, none); // first: the place among all lanes of the grid
  const auto n = static_cast<std::int64_t>(rows);
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto p = static_cast<std::size_t>(k);
    if (particles.id[p] == no_point) continue;
    const auto along = grid_->along(grid_->cell_of(particles.position(p)));
    row[p] = static_cast<std::uint32_t>(grid_->row_of(along) * tiles_along_x() * lanes + along[0]);
  }
  std::vector<std::uint32_t> count(static_cast<std::size_t>(tile_count()) * tile_cells, 0);
  std::vector<std::uint32_t> rank(rows, 0);
  for (std::size_t p = 0; p < rows; ++p)
    if (row[p] != none) rank[p] = count[row[p]]++;

  tiles_.clear();
  free_.clear();
  slot_of_.assign(static_cast<std::size_t>(tile_count()), none);
  ranks_ = 0;
  for (std::size_t index = 0; index < slot_of_.size(); ++index) {
    const auto from = count.begin() + static_cast<std::ptrdiff_t>(index * tile_cells);
    const std::uint32_t most = *std::max_element(from, from + lanes);
    if (most == 0) continue;
    slot_of_[index] = static_cast<std::uint32_t>(tiles_.size());
    Tile& tile = tiles_.emplace_back(empty_tile(static_cast<int>(index)));
    std::copy_n(from, tile_cells, tile.count.begin());
    tile.capacity = tile.ranks = most;
    tile.row = static_cast<std::uint32_t>(ranks_ * tile_cells);
    ranks_ += most;
  }
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto p = static_cast<std::size_t>(k);
    if (row[p] == none) continue;
    const auto lane = static_cast<std::uint32_t>(row[p] % tile_cells);
    row[p] = static_cast<std::uint32_t>(tiles_[slot_of_[row[p] / tile_cells]].row +
                                        rank[p] * tile_cells + lane);
  }
  particles.rearrange(row, ranks_ * tile_cells);
  find_node_runs();
  find_sides();
}

template <int Dim, int width, std::size_t tile_cells>
void CellOrder<Dim, width, tile_cells>::find_node_runs() {
  const int row = grid_->nodes[0];
  const int runs_in_row = (row - 1) / lanes + 1;
  const auto run_at = [&](int node) {
    return static_cast<std::size_t>(node / row * runs_in_row + node % row / lanes);
  };
  run_of_.assign(static_cast<std::size_t>(grid_->node_count / row * runs_in_row), none);
  // Calls visit(number of the run, line, whether these are the tile's last nodes).
  const auto for_each_run = [&](const Tile& tile, auto&& visit) {
    for (std::size_t line = 0; line < lines; ++line) {
      const int node = tile.first_node + grid_->corner_offset[line * width];
      visit(run_at(node), line, false);
      if (node % row + lanes < row) visit(run_at(node) + 1, line, true);
    }
  };

  constexpr std::uint32_t active = 0;
  for (const Tile& tile : tiles_)
    for_each_run(tile, [&](std::size_t run, std::size_t, bool) { run_of_[run] = active; });
  runs_.clear();
  for (std::size_t k = 0; k < run_of_.size(); ++k) {
    if (run_of_[k] == none) continue;
    run_of_[k] = static_cast<std::uint32_t>(runs_.size());
    const int in_row = static_cast<int>(k) % runs_in_row * lanes;
    NodeRun& run = runs_.emplace_back();
    run.node = static_cast<int>(k) / runs_in_row * row + in_row;
    run.count = static_cast<std::size_t>(std::min(lanes, row - in_row));
    run.whole.fill(static_cast<std::uint32_t>(entry(tiles_.size())));
    run.ends = run.whole;
  }
  for (std::size_t slot = 0; slot < tiles_.size(); ++slot)
    for_each_run(tiles_[slot], [&](std::size_t run, std::size_t line, bool last) {
      NodeRun& of = runs_[run_of_[run]];
      (last ? of.ends : of.whole)[line] =
          static_cast<std::uint32_t>(entry(slot) + (last ? tile_cells : 0));
    });
}

template <int Dim, int width, std::size_t tile_cells>
void CellOrder<Dim, width, tile_cells>::find_sides() {
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      side_pairs_[axis][side].clear();
      side_tiles_[axis][side].clear();
      if (!grid_->acts[axis][side]) continue;
      for (std::uint32_t slot = 0; slot < tiles_.size(); ++slot) {
        const int first = tiles_[slot].along[axis];
        const int last = axis == 0 ? std::min(first + lanes, grid_->cells[0]) - 1 : first;
        if (side == 0 ? first == 0 : last == grid_->cells[axis] - 1)
          side_tiles_[axis][side].push_back(slot);
      }
      for (const auto& [outer, inner] : grid_->side_layers(axis, side))
        find_side_pairs(axis, outer, inner, side_pairs_[axis][side]);
    }
}

/// Of one layer.
template <int Dim, int width, std::size_t tile_cells>
void CellOrder<Dim, width, tile_cells>::find_side_pairs(std::size_t axis, int outer, int inner,
                                                        std::vector<SidePair>& pairs) const {
  const int inwards = (inner - outer) * grid_->node_stride[axis];
  for (const NodeRun& run : runs_)
    for (int node = run.node; node < run.node + static_cast<int>(run.count); ++node)
      if (grid_->node_along(node, axis) == outer) pairs.push_back({node, node + inwards});
}

template class CellOrder<2, 2, tile_cells<Real>>;
template class CellOrder<2, 2, tile_cells<float>>;
template class CellOrder<2, 3, tile_cells<Real>>;
template class CellOrder<2, 3, tile_cells<float>>;
template class CellOrder<2, 4, tile_cells<Real>>;
template class CellOrder<3, 2, tile_cells<Real>>;
template class CellOrder<3, 2, tile_cells<float>>;
template class CellOrder<3, 3, tile_cells<Real>>;
template class CellOrder<3, 3, tile_cells<float>>;
template class CellOrder<3, 4, tile_cells<Real>>;

template void CellOrder<2, 2, tile_cells<Real>>::update(Particles<2>&);
template void CellOrder<2, 3, tile_cells<Real>>::update(Particles<2>&);
template void CellOrder<2, 4, tile_cells<Real>>::update(Particles<2>&);
template void CellOrder<3, 2, tile_cells<Real>>::update(Particles<3>&);
template void CellOrder<3, 3, tile_cells<Real>>::update(Particles<3>&);
template void CellOrder<3, 4, tile_cells<Real>>::update(Particles<3>&);
template void CellOrder<2, 2, tile_cells<float>>::update(Particles<2, float>&);
template void CellOrder<2, 3, tile_cells<float>>::update(Particles<2, float>&);
template void CellOrder<3, 2, tile_cells<float>>::update(Particles<3, float>&);
template void CellOrder<3, 3, tile_cells<float>>::update(Particles<3, float>&);

} // namespace scarp
