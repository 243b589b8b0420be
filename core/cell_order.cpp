#include "core/cell_order.hpp"

#include <algorithm>
#include <omp.h>

namespace scarp {

template <int Dim, int corners>
template <class T>
void CellOrder<Dim, corners>::update(Particles<Dim, T>& particles) {
  const std::size_t points = particles.size();
  const bool first = cell_of_.size() != points;
  if (first) cell_of_.assign(points, -1);

  std::vector<Move> moves = find_moves(particles.x);
  if (moves.empty()) return;

  const auto part = static_cast<std::size_t>(reorder_part * static_cast<double>(points));
  previous_.swap(occupied_);
  if (first || moves.size() > part) {
    count_points();
  } else {
    std::ranges::sort(moves);
    follow(moves);
  }
  moved_ += moves.size();
  if (first || moved_ > part) reorder(particles);
  if (occupied_ != previous_) {
    find_places();
    find_parts();
    find_node_runs();
    find_side_pairs();
  }
}

/// Brings `cell_of_` up to date.  The order of the moves depends on the threads.
template <int Dim, int corners>
auto CellOrder<Dim, corners>::find_moves(const std::array<Column, Dim>& x) -> std::vector<Move> {
  constexpr std::int64_t block = 256; // tested at once: nearly all points stay
  std::vector<std::vector<Move>> of_thread(static_cast<std::size_t>(omp_get_max_threads()));
  const auto n = static_cast<std::int64_t>(x[0].size());
#pragma omp parallel
  {
    std::vector<Move>& own = of_thread[static_cast<std::size_t>(omp_get_thread_num())];
    std::array<int, block> cell;
#pragma omp for schedule(static) nowait
    for (std::int64_t start = 0; start < n; start += block) {
      const auto first = static_cast<std::size_t>(start);
      const auto size = static_cast<std::size_t>(std::min(block, n - start));
      int changed = 0;
      for (std::size_t k = 0; k < size; ++k) {
        Vec<Dim> place;
        for (std::size_t i = 0; i < Dim; ++i) place[i] = x[i][first + k];
        cell[k] = grid_->cell_of(place);
        changed |= cell[k] ^ cell_of_[first + k];
      }
      if (changed == 0) continue;
      for (std::size_t k = 0; k < size; ++k) {
        if (cell[k] == cell_of_[first + k]) continue;
        own.push_back({cell[k], static_cast<std::uint32_t>(first + k), cell_of_[first + k]});
        cell_of_[first + k] = cell[k];
      }
    }
  }
  std::vector<Move> moves;
  for (const std::vector<Move>& own : of_thread) moves.insert(moves.end(), own.begin(), own.end());
  return moves;
}

/// Counting sort by cell, stable in the rows.
template <int Dim, int corners> void CellOrder<Dim, corners>::count_points() {
  std::fill(count_.begin(), count_.end(), 0U);
  for (const int cell : cell_of_) ++count_[static_cast<std::size_t>(cell)];

  occupied_.clear();
  begin_.clear();
  std::uint32_t start = 0;
  for (std::size_t cell = 0; cell + 1 < count_.size(); ++cell) {
    const std::uint32_t here = count_[cell];
    if (here == 0) continue;
    occupied_.push_back(static_cast<int>(cell));
    begin_.push_back(start);
    count_[cell] = start;
    start += here;
  }
  begin_.push_back(start);

  rows_.resize(cell_of_.size());
  for (std::size_t p = 0; p < cell_of_.size(); ++p)
    rows_[count_[static_cast<std::size_t>(cell_of_[p])]++] = static_cast<std::uint32_t>(p);
}

/// What count_points() would give, from the order before and the few moves since then, which are
/// sorted: cells between those that lost or gained points keep their rows and are copied at once.
template <int Dim, int corners>
void CellOrder<Dim, corners>::follow(const std::vector<Move>& moves) {
  std::vector<int> touched;
  for (const Move& move : moves) {
    touched.push_back(move.from);
    touched.push_back(move.to);
  }
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());

  previous_begin_.swap(begin_);
  previous_rows_.swap(rows_);
  occupied_.clear();
  begin_.clear();
  rows_.clear();
  std::size_t slot = 0; // in the order before, from which everything below is taken over
  const auto copy_cells = [&](std::size_t end) {
    const auto shift = static_cast<std::uint32_t>(rows_.size()) - previous_begin_[slot];
    for (std::size_t s = slot; s < end; ++s) begin_.push_back(previous_begin_[s] + shift);
    occupied_.insert(occupied_.end(), previous_.begin() + static_cast<std::ptrdiff_t>(slot),
                     previous_.begin() + static_cast<std::ptrdiff_t>(end));
    rows_.insert(rows_.end(), previous_rows_.begin() + previous_begin_[slot],
                 previous_rows_.begin() + previous_begin_[end]);
    slot = end;
  };

  auto arrived = moves.begin();
  for (const int cell : touched) {
    const auto at = std::lower_bound(previous_.begin() + static_cast<std::ptrdiff_t>(slot),
                                     previous_.end(), cell);
    copy_cells(static_cast<std::size_t>(at - previous_.begin()));
    const auto start = static_cast<std::uint32_t>(rows_.size());
    if (at != previous_.end() && *at == cell) {
      for (std::uint32_t k = previous_begin_[slot]; k < previous_begin_[slot + 1]; ++k)
        if (cell_of_[previous_rows_[k]] == cell) rows_.push_back(previous_rows_[k]);
      ++slot;
    }
    const auto stayed = static_cast<std::ptrdiff_t>(rows_.size());
    for (; arrived != moves.end() && arrived->to == cell; ++arrived) rows_.push_back(arrived->row);
    std::inplace_merge(rows_.begin() + start, rows_.begin() + stayed, rows_.end());
    if (rows_.size() == start) continue;
    occupied_.push_back(cell);
    begin_.push_back(start);
  }
  copy_cells(previous_.size());
  begin_.push_back(static_cast<std::uint32_t>(rows_.size()));
}

template <int Dim, int corners>
template <class T>
void CellOrder<Dim, corners>::reorder(Particles<Dim, T>& particles) {
  // Most rows follow each other: pieces of them are copied at once.
  struct Piece {
    std::uint32_t from, to, count;
  };
  std::vector<Piece> pieces;
  constexpr std::uint32_t most = 4096; // for the threads
  for (std::uint32_t k = 0; k < rows_.size(); ++k) {
    if (k == 0 || rows_[k] != rows_[k - 1] + 1 || pieces.back().count == most)
      pieces.push_back({rows_[k], k, 0});
    ++pieces.back().count;
  }
  const auto permute = [&](auto& column) {
    auto& sorted = std::get<std::remove_cvref_t<decltype(column)>>(spare_);
    sorted.resize(column.size());
    const auto n = static_cast<std::int64_t>(pieces.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t k = 0; k < n; ++k) {
      const auto [from, to, count] = pieces[static_cast<std::size_t>(k)];
      for (std::uint32_t i = 0; i < count; ++i) sorted[to + i] = column[from + i];
    }
    column.swap(sorted);
  };
  particles.for_each_column(permute);
  permute(cell_of_);
  for (std::size_t k = 0; k < rows_.size(); ++k) rows_[k] = static_cast<std::uint32_t>(k);
  moved_ = 0;
}

template <int Dim, int corners> void CellOrder<Dim, corners>::find_places() {
  const std::size_t cells = occupied_.size();
  const auto width = static_cast<std::uint32_t>(grid_->width);
  places_.resize(cells + 1);
  std::uint32_t entry = 0;
  std::array<int, Dim> along = {};
  int row = 0; // the first cell of the present one
  for (std::size_t slot = 0; slot < cells; ++slot) {
    if (occupied_[slot] >= row + grid_->cells[0] || slot == 0) {
      along = grid_->along(occupied_[slot]);
      row = occupied_[slot] - along[0];
    }
    along[0] = occupied_[slot] - row;
    const bool goes_on =
        slot % block_cells != 0 && occupied_[slot - 1] + 1 == occupied_[slot] && along[0] > 0;
    entry = slot == 0 ? 0 : entry + (goes_on ? 1 : width);
    places_[slot] = {grid_->first_node(along), entry, along};
  }
  places_[cells] = {0, entry + width, {}};
}

/// The lines of all strips, in the order of their first nodes.
template <int Dim, int corners> void CellOrder<Dim, corners>::find_parts() {
  const auto width = static_cast<std::uint32_t>(grid_->width);
  std::vector<Part> strips;
  for (std::size_t slot = 0; slot < cells(); ++slot) {
    if (slot == 0 || !strip_goes_on(slot - 1))
      strips.push_back({places_[slot].first_node, places_[slot].entry, 0, width});
    else
      ++strips.back().count;
  }
  // Line by line they are in order already.
  parts_.clear();
  for (std::uint32_t line = 0; line * width < corners; ++line) {
    const auto before = static_cast<std::ptrdiff_t>(parts_.size());
    for (Part part : strips) {
      part.line = line;
      part.node += grid_->corner_offset[line * width];
      parts_.push_back(part);
    }
    std::ranges::inplace_merge(parts_, parts_.begin() + before, {}, &Part::node);
  }
}

/// Unites the parts that overlap or touch, and cuts the whole into runs.
template <int Dim, int corners> void CellOrder<Dim, corners>::find_node_runs() {
  const std::vector<Part> whole = std::move(parts_);
  parts_.clear();
  runs_.clear();
  const auto end_of = [](const Part& part) { return part.node + static_cast<int>(part.count); };
  for (std::size_t k = 0; k < whole.size();) {
    const std::size_t first = k;
    int end = end_of(whole[k]);
    for (++k; k < whole.size() && whole[k].node <= end; ++k) end = std::max(end, end_of(whole[k]));
    std::size_t reaches = first; // the first part that reaches the present run
    for (int node = whole[first].node; node < end; node += static_cast<int>(NodeRun::most)) {
      const int last = std::min(end, node + static_cast<int>(NodeRun::most));
      NodeRun run = {node, static_cast<std::size_t>(last - node), parts_.size(), 0};
      while (reaches < k && end_of(whole[reaches]) <= node) ++reaches;
      for (std::size_t p = reaches; p < k && whole[p].node < last; ++p) {
        const int from = std::max(node, whole[p].node);
        const int to = std::min(last, end_of(whole[p]));
        if (from < to)
          parts_.push_back({from, whole[p].entry + static_cast<std::uint32_t>(from - whole[p].node),
                            whole[p].line, static_cast<std::uint32_t>(to - from)});
      }
      run.end_part = parts_.size();
      runs_.push_back(run);
    }
  }
}

template <int Dim, int corners> void CellOrder<Dim, corners>::find_side_pairs() {
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      side_pairs_[axis][side].clear();
      if (!grid_->acts[axis][side]) continue;
      for (const auto& [outer, inner] : grid_->side_layers(axis, side))
        find_side_pairs(axis, outer, inner, side_pairs_[axis][side]);
    }
}

/// Of one layer.  A run may go on from the end of a row to the next one.
template <int Dim, int corners>
void CellOrder<Dim, corners>::find_side_pairs(std::size_t axis, int outer, int inner,
                                              std::vector<SidePair>& pairs) const {
  const int row = grid_->nodes[0];
  const int inwards = (inner - outer) * grid_->node_stride[axis];
  for (const NodeRun& run : runs_) {
    const int run_end = run.node + static_cast<int>(run.count);
    for (int first = run.node, end = 0; first < run_end; first = end) {
      end = std::min(run_end, (first / row + 1) * row);
      const int along = grid_->node_along(first, axis);
      if (axis > 0 && along == outer)
        for (int node = first; node < end; ++node) pairs.push_back({node, node + inwards});
      const int on_side = first + outer - along;
      if (axis == 0 && first <= on_side && on_side < end)
        pairs.push_back({on_side, on_side + inwards});
    }
  }
}

template class CellOrder<2, 4>;
template class CellOrder<2, 9>;
template class CellOrder<2, 16>;
template class CellOrder<3, 8>;
template class CellOrder<3, 27>;
template class CellOrder<3, 64>;

template void CellOrder<2, 4>::update(Particles<2>&);
template void CellOrder<2, 9>::update(Particles<2>&);
template void CellOrder<2, 16>::update(Particles<2>&);
template void CellOrder<3, 8>::update(Particles<3>&);
template void CellOrder<3, 27>::update(Particles<3>&);
template void CellOrder<3, 64>::update(Particles<3>&);
template void CellOrder<2, 4>::update(Particles<2, float>&);
template void CellOrder<2, 9>::update(Particles<2, float>&);
template void CellOrder<3, 8>::update(Particles<3, float>&);
template void CellOrder<3, 27>::update(Particles<3, float>&);

} // namespace scarp
