#include "render/geometry.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace scarp::render {

namespace {

/// The part [first, second] of the segment's parameter 0...1 that lies in the box.
std::optional<std::pair<double, double>> inside(Point a, Point b, const Box& box) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const std::array<double, 4> p = {-dx, dx, -dy, dy};
  const std::array<double, 4> q = {a.x - box.lower.x, box.upper.x - a.x, a.y - box.lower.y,
                                   box.upper.y - a.y};
  double first = 0.0;
  double last = 1.0;
  for (std::size_t side = 0; side < 4; ++side) {
    if (p[side] == 0.0) {
      if (q[side] < 0.0) return std::nullopt;
    } else if (p[side] < 0.0) {
      first = std::max(first, q[side] / p[side]);
    } else {
      last = std::min(last, q[side] / p[side]);
    }
  }
  if (first > last) return std::nullopt;
  return std::pair{first, last};
}

Point between(Point a, Point b, double part) {
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}

/// `distance` is positive inside and linear.
template <class Distance> Polyline half_plane(const Polyline& polygon, Distance distance) {
  Polyline kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % polygon.size()];
    const double at_a = distance(a);
    const double at_b = distance(b);
    if (at_a >= 0.0) kept.push_back(a);
    if ((at_a >= 0.0) != (at_b >= 0.0)) kept.push_back(between(a, b, at_a / (at_a - at_b)));
  }
  return kept;
}

} // namespace

std::vector<Polyline> clipped(const Polyline& line, const Box& box) {
  std::vector<Polyline> parts;
  bool open = false; // the last part ends at line[i]
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto part = inside(line[i], line[i + 1], box);
    if (!part) {
      open = false;
      continue;
    }
    if (!open) parts.push_back({between(line[i], line[i + 1], part->first)});
    parts.back().push_back(between(line[i], line[i + 1], part->second));
    open = part->second == 1.0;
  }
  return parts;
}

Polyline clipped_polygon(Polyline polygon, const Box& box) {
  polygon = half_plane(polygon, [&](Point point) { return point.x - box.lower.x; });
  polygon = half_plane(polygon, [&](Point point) { return box.upper.x - point.x; });
  polygon = half_plane(polygon, [&](Point point) { return point.y - box.lower.y; });
  return half_plane(polygon, [&](Point point) { return box.upper.y - point.y; });
}

} // namespace scarp::render
