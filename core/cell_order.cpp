#include "core/cell_order.hpp"

#include <algorithm>
#include <omp.h>

namespace scarp {

template <int Dim, int corners> void CellOrder<Dim, corners>::update(Particles<Dim>& particles) {
  const std::size_t points = particles.size();
  const bool first = cell_of_.size() != points;
  if (first) cell_of_.assign(points, -1);

  std::vector<Move> moves = find_moves(particles);
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
    find_nodes();
  }
}

/// Brings `cell_of_` up to date.  The order of the moves depends on the threads.
template <int Dim, int corners>
auto CellOrder<Dim, corners>::find_moves(const Particles<Dim>& particles) -> std::vector<Move> {
  constexpr std::int64_t block = 256; // tested at once: nearly all points stay
  std::vector<std::vector<Move>> of_thread(static_cast<std::size_t>(omp_get_max_threads()));
  const auto n = static_cast<std::int64_t>(particles.size());
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
        cell[k] = grid_->cell_of(particles.position(first + k));
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

template <int Dim, int corners> void CellOrder<Dim, corners>::reorder(Particles<Dim>& particles) {
  const auto permute = [this](auto& column) {
    std::remove_reference_t<decltype(column)> sorted(column.size());
    const auto n = static_cast<std::int64_t>(rows_.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t k = 0; k < n; ++k)
      sorted[static_cast<std::size_t>(k)] = column[rows_[static_cast<std::size_t>(k)]];
    column.swap(sorted);
  };
  particles.for_each_column(permute);
  permute(cell_of_);
  for (std::size_t k = 0; k < rows_.size(); ++k) rows_[k] = static_cast<std::uint32_t>(k);
  moved_ = 0;
}

template <int Dim, int corners> void CellOrder<Dim, corners>::find_places() {
  places_.resize(occupied_.size());
  const auto n = static_cast<std::int64_t>(occupied_.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto slot = static_cast<std::size_t>(k);
    places_[slot] = {grid_->first_node(occupied_[slot]), grid_->along(occupied_[slot])};
  }
}

/// A cell is known by its lowest node here: the cell of which node n is corner c has the lowest
/// node n - corner_offset[c], and where there is no such cell, no cell ever has that one.
template <int Dim, int corners> void CellOrder<Dim, corners>::find_nodes() {
  const int padding = grid_->reach();
  std::fill(slot_.begin(), slot_.end(), -1);
  for (std::size_t s = 0; s < occupied_.size(); ++s)
    slot_[static_cast<std::size_t>(places_[s].first_node + padding)] = static_cast<int>(s);

  // In blocks of nodes, each on one thread, then one after the other.
  constexpr std::int64_t block = 4096;
  const std::int64_t begin = places_.front().first_node;
  const std::int64_t end = places_.back().first_node + padding + 1;
  const std::int64_t blocks = (end - begin + block - 1) / block;
  std::vector<std::vector<Node>> found(static_cast<std::size_t>(blocks));
#pragma omp parallel for schedule(static)
  for (std::int64_t b = 0; b < blocks; ++b) {
    const std::int64_t last = std::min(end, begin + (b + 1) * block);
    for (std::int64_t index = begin + b * block; index < last; ++index) {
      Node node{static_cast<int>(index), {}};
      int none = -1; // stays negative as long as all slots are
      for (std::size_t c = 0; c < corners; ++c) {
        node.slot[c] = slot_[static_cast<std::size_t>(index - grid_->corner_offset[c] + padding)];
        none &= node.slot[c];
      }
      if (none >= 0) found[static_cast<std::size_t>(b)].push_back(node);
    }
  }
  nodes_.clear();
  for (const std::vector<Node>& part : found) nodes_.insert(nodes_.end(), part.begin(), part.end());
}

template class CellOrder<2, 4>;
template class CellOrder<2, 9>;
template class CellOrder<2, 16>;
template class CellOrder<3, 8>;
template class CellOrder<3, 27>;
template class CellOrder<3, 64>;

} // namespace scarp
