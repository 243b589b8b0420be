#include "core/cell_order.hpp"

#include <algorithm>

namespace scarp {

template <int Dim, int corners> void CellOrder<Dim, corners>::update(Particles<Dim>& particles) {
  const std::size_t points = particles.size();
  const bool first = cell_of_.size() != points;
  if (first) cell_of_.assign(points, -1);

  std::size_t moved = 0;
  const auto n = static_cast<std::int64_t>(points);
#pragma omp parallel for schedule(static) reduction(+ : moved)
  for (std::int64_t i = 0; i < n; ++i) {
    const auto p = static_cast<std::size_t>(i);
    const int cell = grid_->cell_of(particles.position(p));
    if (cell != cell_of_[p]) {
      cell_of_[p] = cell;
      ++moved;
    }
  }
  if (moved == 0) return;

  moved_ += moved;
  count_points(points);
  if (first || static_cast<double>(moved_) > reorder_part * static_cast<double>(points))
    reorder(particles);
  if (occupied_ != previous_) find_nodes();
}

/// Counting sort by cell, stable in the rows.
template <int Dim, int corners> void CellOrder<Dim, corners>::count_points(std::size_t points) {
  std::fill(count_.begin(), count_.end(), 0U);
  for (const int cell : cell_of_) ++count_[static_cast<std::size_t>(cell)];

  previous_.swap(occupied_);
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

  rows_.resize(points);
  for (std::size_t p = 0; p < points; ++p)
    rows_[count_[static_cast<std::size_t>(cell_of_[p])]++] = static_cast<std::uint32_t>(p);
}

template <int Dim, int corners> void CellOrder<Dim, corners>::reorder(Particles<Dim>& particles) {
  const auto permute = [this](auto& column) {
    auto sorted = column;
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

/// A cell is known by its lowest node here: the cell of which node n is corner c has the lowest
/// node n - corner_offset[c], and where there is no such cell, no cell ever has that one.
template <int Dim, int corners> void CellOrder<Dim, corners>::find_nodes() {
  const int padding = grid_->reach();
  const auto slot_at = [&](int node) -> int& {
    return slot_[static_cast<std::size_t>(node + padding)];
  };
  for (const int cell : previous_) {
    const int first = grid_->first_node(cell);
    slot_at(first) = -1;
    for (std::size_t c = 0; c < corners; ++c)
      active_[static_cast<std::size_t>(first + grid_->corner_offset[c])] = 0;
  }
  for (std::size_t s = 0; s < occupied_.size(); ++s) {
    const int first = grid_->first_node(occupied_[s]);
    slot_at(first) = static_cast<int>(s);
    for (std::size_t c = 0; c < corners; ++c)
      active_[static_cast<std::size_t>(first + grid_->corner_offset[c])] = 1;
  }

  nodes_.clear();
  const int begin = grid_->first_node(occupied_.front());
  const int end = grid_->first_node(occupied_.back()) + padding + 1;
  for (int index = begin; index < end; ++index) {
    if (active_[static_cast<std::size_t>(index)] == 0) continue;
    Node node{index, {}};
    for (std::size_t c = 0; c < corners; ++c)
      node.slot[c] = slot_at(index - grid_->corner_offset[c]);
    nodes_.push_back(node);
  }
}

template class CellOrder<2, 4>;
template class CellOrder<2, 9>;
template class CellOrder<2, 16>;
template class CellOrder<3, 8>;
template class CellOrder<3, 27>;
template class CellOrder<3, 64>;

} // namespace scarp
