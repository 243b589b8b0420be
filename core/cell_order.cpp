#include "core/cell_order.hpp"

#include <algorithm>
#include <omp.h>

namespace scarp {

template <int Dim, int width, std::size_t tile_cells>
template <class T>
void CellOrder<Dim, width, tile_cells>::update(Particles<Dim, T>& particles,
                                               const std::vector<std::uint8_t>& left) {
  if (tiles_.empty()) return rebuild(particles);
  const std::size_t before = tiles_.size();
  const auto n = static_cast<std::int64_t>(before);
  leaving_.resize(static_cast<std::size_t>(omp_get_max_threads()));
  for (Leaving& out : leaving_) out.clear();
  // Fewer are done before other threads have woken up.  Who does it does not matter: the lists,
  // one behind the other, are in the order of the tiles.
  constexpr std::size_t several = 256;
  const std::size_t look_at =
      left.empty()
          ? before
          : before - static_cast<std::size_t>(std::count(left.begin(), left.begin() + n, 0));
#pragma omp parallel if (look_at > several)
  {
    Leaving& out = leaving_[static_cast<std::size_t>(omp_get_thread_num())];
#pragma omp for schedule(static)
    for (std::int64_t slot = 0; slot < n; ++slot)
      if (left.empty() || left[static_cast<std::size_t>(slot)] != 0)
        take_out(static_cast<std::uint32_t>(slot), particles, out);
  }
  for (const Leaving& out : leaving_) {
    idle_.insert(idle_.end(), out.ranks.begin(), out.ranks.end());
    strays_ -= out.ranks.size();
    unfilled_ += out.unfilled;
    empty_tiles_ += out.emptied;
  }
  std::size_t moves = 0;
  for (Leaving& out : leaving_) {
    moves += out.moves.size();
    for (Move& move : out.moves) find_row(move);
  }
  particles.resize(next_.size() * tile_cells);
  const std::size_t bytes = particles.row_bytes();
  const auto lists = static_cast<std::int64_t>(leaving_.size());
#pragma omp parallel for schedule(static) if (moves > several)
  for (std::int64_t k = 0; k < lists; ++k) {
    const Leaving& out = leaving_[static_cast<std::size_t>(k)];
    for (std::size_t m = 0; m < out.moves.size(); ++m)
      particles.put_in(out.moves[m].to_row, &out.points[m * bytes]);
  }

  constexpr std::size_t few = 4; // of a small scene
  const bool idle = idle_.size() + static_cast<std::size_t>(unfilled_) > next_.size() / 4 + few;
  const bool disorderly = strays_ > next_.size() / 16 + few;
  const bool empty = empty_tiles_ > tiles_.size() / 4 + few;
  if (idle || disorderly || empty) return rebuild(particles);
  if (tiles_.size() == before) return;
  find_node_runs();
  find_sides();
}

template <int Dim, int width, std::size_t tile_cells>
auto CellOrder<Dim, width, tile_cells>::cell(std::size_t tile, std::size_t lane) const -> Cell {
  const Tile& in = tiles_[tile];
  Cell cell = {
      in.along,      in.first_node + static_cast<int>(lane), entry(tile) + lane, ranks(in), lane,
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

/// Takes the points that have left their cells out of a tile's rows.
template <int Dim, int width, std::size_t tile_cells>
template <class T>
void CellOrder<Dim, width, tile_cells>::take_out(std::uint32_t slot, Particles<Dim, T>& particles,
                                                 Leaving& out) {
  using Places = Lanes<Real, tile_cells>;
  Tile& tile = tiles_[slot];
  const Places count([&](auto lane) { return static_cast<Real>(tile.count[lane]); });
  const auto have_left = [&](const Rank& rank) {
    auto left = count < 0.0;
    for (std::size_t i = 0; i < Dim; ++i) {
      Places xi =
          grid_->scaled(Places(&particles.x[i][rank.row], std::experimental::element_aligned), i) -
          static_cast<Real>(tile.along[i]);
      if (i == 0) xi -= lane_numbers<Real, tile_cells>();
      left = left || xi < 0.0 || xi >= 1.0;
    }
    return left && count > static_cast<Real>(rank.number);
  };
  bool all_here = true;
  for (const Rank& rank : ranks(tile)) all_here = all_here && none_of(have_left(rank));
  if (all_here) return;

  // From the last rank on, so that what fills a gap is a point that stays.
  std::vector<Rank>& by_number = out.of_tile;
  by_number.clear();
  for (const Rank& rank : ranks(tile)) by_number.push_back(rank);
  for (std::uint32_t number = tile.ranks; number-- > 0;) {
    const std::size_t row = by_number[number].row;
    const auto left = have_left(by_number[number]);
    for (std::uint32_t lane = 0; lane < tile_cells; ++lane) {
      if (!left[lane]) continue;
      const auto to = grid_->along(grid_->cell_of(particles.position(row + lane)));
      out.moves.push_back({grid_->row_of(to) * tiles_along_x() + to[0] / lanes,
                           static_cast<std::uint32_t>(to[0] % lanes), none});
      const std::size_t taken = out.points.size();
      out.points.resize(taken + particles.row_bytes());
      particles.take_out(row + lane, &out.points[taken]);
      const std::uint32_t last = --tile.count[lane];
      if (number != last) particles.move_row(by_number[last].row + lane, row + lane);
    }
  }
  const auto unfilled = [&] { return tile.home > tile.ranks ? tile.home - tile.ranks : 0; };
  out.unfilled -= unfilled();
  tile.ranks = *std::ranges::max_element(tile.count);
  out.unfilled += unfilled();
  for (std::size_t number = std::max(tile.ranks, tile.home); number < by_number.size(); ++number)
    out.ranks.push_back(static_cast<std::uint32_t>(by_number[number].row));
  if (tile.ranks == 0) ++out.emptied;
}

/// In the cell that the point has come to.
template <int Dim, int width, std::size_t tile_cells>
void CellOrder<Dim, width, tile_cells>::find_row(Move& move) {
  std::uint32_t& slot = slot_of_[static_cast<std::size_t>(move.to_tile)];
  if (slot == none) {
    slot = static_cast<std::uint32_t>(tiles_.size());
    grow(tiles_, tiles_.size() + 1, empty_tile(move.to_tile));
    ++empty_tiles_;
  }
  Tile& tile = tiles_[slot];
  const std::uint32_t number = tile.count[move.to_lane]++;
  const bool full = number == tile.ranks && number >= tile.home;
  const std::uint32_t added = full ? take_rank() : none;
  if (number == tile.ranks) {
    if (number == 0) --empty_tiles_;
    if (number < tile.home) --unfilled_;
    ++tile.ranks;
  }
  std::uint32_t* link = &tile.row;
  for (std::uint32_t k = 0; k < number; ++k) link = &next_[*link / tile_cells];
  if (full) *link = added;
  move.to_row = *link + move.to_lane;
}

/// Its first row.
template <int Dim, int width, std::size_t tile_cells>
std::uint32_t CellOrder<Dim, width, tile_cells>::take_rank() {
  if (idle_.empty()) { // several more at once, the lowest one first
    const std::size_t before = next_.size(), after = before + before / 256 + 1;
    grow(next_, after, none);
    for (std::size_t k = after; k-- > before;)
      idle_.push_back(static_cast<std::uint32_t>(k * tile_cells));
  }
  const std::uint32_t row = idle_.back();
  idle_.pop_back();
  ++strays_;
  return row;
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
  next_.clear();
  idle_.clear();
  strays_ = empty_tiles_ = 0;
  unfilled_ = 0;
  slot_of_.assign(static_cast<std::size_t>(tile_count()), none);
  for (std::size_t index = 0; index < slot_of_.size(); ++index) {
    const auto from = count.begin() + static_cast<std::ptrdiff_t>(index * tile_cells);
    const std::uint32_t most = *std::max_element(from, from + lanes);
    if (most == 0) continue;
    slot_of_[index] = static_cast<std::uint32_t>(tiles_.size());
    Tile& tile = tiles_.emplace_back(empty_tile(static_cast<int>(index)));
    std::copy_n(from, tile_cells, tile.count.begin());
    tile.ranks = tile.home = most;
    tile.row = static_cast<std::uint32_t>(next_.size() * tile_cells);
    for (std::uint32_t k = 0; k < most; ++k)
      next_.push_back(static_cast<std::uint32_t>((next_.size() + 1) * tile_cells));
  }
  tiles_.shrink_to_fit();
  next_.shrink_to_fit();
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto p = static_cast<std::size_t>(k);
    if (row[p] == none) continue;
    const auto lane = static_cast<std::uint32_t>(row[p] % tile_cells);
    row[p] = static_cast<std::uint32_t>(tiles_[slot_of_[row[p] / tile_cells]].row +
                                        rank[p] * tile_cells + lane);
  }
  particles.rearrange(row, next_.size() * tile_cells);
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
  runs_.shrink_to_fit();
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

template void CellOrder<2, 2, tile_cells<Real>>::update(Particles<2>&,
                                                        const std::vector<std::uint8_t>&);
template void CellOrder<2, 3, tile_cells<Real>>::update(Particles<2>&,
                                                        const std::vector<std::uint8_t>&);
template void CellOrder<2, 4, tile_cells<Real>>::update(Particles<2>&,
                                                        const std::vector<std::uint8_t>&);
template void CellOrder<3, 2, tile_cells<Real>>::update(Particles<3>&,
                                                        const std::vector<std::uint8_t>&);
template void CellOrder<3, 3, tile_cells<Real>>::update(Particles<3>&,
                                                        const std::vector<std::uint8_t>&);
template void CellOrder<3, 4, tile_cells<Real>>::update(Particles<3>&,
                                                        const std::vector<std::uint8_t>&);
template void CellOrder<2, 2, tile_cells<float>>::update(Particles<2, float>&,
                                                         const std::vector<std::uint8_t>&);
template void CellOrder<2, 3, tile_cells<float>>::update(Particles<2, float>&,
                                                         const std::vector<std::uint8_t>&);
template void CellOrder<3, 2, tile_cells<float>>::update(Particles<3, float>&,
                                                         const std::vector<std::uint8_t>&);
template void CellOrder<3, 3, tile_cells<float>>::update(Particles<3, float>&,
                                                         const std::vector<std::uint8_t>&);

} // namespace scarp
