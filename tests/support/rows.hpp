// The rows of Particles that have a point.
#pragma once

#include "core/particles.hpp"

#include <vector>

namespace scarp::test {

template <int Dim, class T> std::vector<std::size_t> rows_of(const Particles<Dim, T>& points) {
  std::vector<std::size_t> rows;
  points.for_each([&](std::size_t p) { rows.push_back(p); });
  return rows;
}

/// kg, by row.
template <int Dim, class T> std::vector<T> masses_of(const Particles<Dim, T>& points) {
  std::vector<T> masses;
  for (std::size_t p = 0; p < points.rows(); ++p) masses.push_back(points.mass(p));
  return masses;
}

} // namespace scarp::test
