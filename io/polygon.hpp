// Simple polygons in a plane.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace scarp::io {

using Polygon = std::vector<std::array<double, 2>>;

/// Never negative, whichever way round the corners go.
double area(const Polygon& polygon);

/// All corners lie on one line, to rounding.
bool is_flat(const Polygon& polygon);

/// Two edges that touch or cross though they are not neighbours, or neighbours that fold back on
/// each other; edge i runs from corner i to the next.  A simple polygon has none.
std::optional<std::pair<std::size_t, std::size_t>> crossing_edges(const Polygon& polygon);

/// From a point to the polygon; 0 inside.
double distance(const Polygon& polygon, const std::array<double, 2>& point);

} // namespace scarp::io
