// Where the points were before the first step, for displacements.
#pragma once

#include "core/grid_index.hpp"
#include "core/particles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scarp {

/// A point that fills a lattice square (core/lattice.hpp) was at its centre: four bytes say which.
/// Only of the others, those of cut squares, the place is kept.
template <int Dim> class FirstPlaces {
 public:
  /// Of points in the order of creation.
  FirstPlaces(const Grid& grid, const std::array<ColumnOf<Real>, Dim>& x)
      : side_(grid.cell_size / grid.points_per_cell) {
    Real all = 1.0;
    for (int a = 0; a < Dim; ++a) {
      const auto i = static_cast<std::size_t>(a);
      const std::size_t axis = scene_axis<Dim>(a);
      lower_[i] = grid.lower[axis];
      along_[i] = static_cast<std::size_t>(std::lround((grid.upper[axis] - lower_[i]) / side_));
      all *= static_cast<Real>(along_[i]);
    }
    squares_.reserve(x[0].size());
    for (std::size_t p = 0; p < x[0].size(); ++p) {
      Vec<Dim> place;
      for (std::size_t i = 0; i < Dim; ++i) place[i] = x[i][p];
      std::size_t square = 0;
      for (std::size_t i = Dim; i-- > 0;)
        square = square * along_[i] + static_cast<std::size_t>((place[i] - lower_[i]) / side_);
      if (all >= static_cast<Real>(cut) || centre(square) != place) {
        cut_points_.push_back(static_cast<std::uint32_t>(p));
        cut_places_.push_back(place);
        square = cut;
      }
      squares_.push_back(static_cast<std::uint32_t>(square));
    }
  }

  std::size_t points() const { return squares_.size(); }

  /// m
  Vec<Dim> of(std::size_t point) const {
    if (squares_[point] != cut) return centre(squares_[point]);
    const auto found = std::ranges::lower_bound(cut_points_, static_cast<std::uint32_t>(point));
    return cut_places_[static_cast<std::size_t>(found - cut_points_.begin())];
  }

  /// Bytes.
  std::size_t memory() const { return bytes_of(squares_, cut_points_, cut_places_); }

 private:
  static constexpr std::uint32_t cut = no_point;

  /// To the bit as in core/lattice.cpp.
  Vec<Dim> centre(std::size_t square) const {
    Vec<Dim> place;
    for (std::size_t i = 0; i < Dim; square /= along_[i], ++i) {
      const auto k = static_cast<Real>(square % along_[i]);
      place[i] = 0.5 * ((lower_[i] + k * side_) + (lower_[i] + (k + 1.0) * side_));
    }
    return place;
  }

  Real side_; ///< m, of a square
  Vec<Dim> lower_;
  std::array<std::size_t, Dim> along_;    ///< squares along each axis
  std::vector<std::uint32_t> squares_;    ///< by point, x fastest; or `cut`
  std::vector<std::uint32_t> cut_points_; ///< in rising order
  std::vector<Vec<Dim>> cut_places_;
};

} // namespace scarp
