#include "render/geometry.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
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

/// Twice the signed area of the triangle: positive if a, b, c turn to the left.
double turn(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether the corner between `a` and `c` can be cut off: it turns to the left and no other corner
/// lies in its triangle.
bool is_ear(const Polyline& polygon, Point a, Point b, Point c) {
  if (!(turn(a, b, c) > 0.0)) return false;
  return std::none_of(polygon.begin(), polygon.end(), [&](Point other) {
    if (other == a || other == b || other == c) return false;
    return turn(a, b, other) >= 0.0 && turn(b, c, other) >= 0.0 && turn(c, a, other) >= 0.0;
  });
}

} // namespace

Box grown(const Box& box, double by) {
  return {{box.lower.x - by, box.lower.y - by}, {box.upper.x + by, box.upper.y + by}};
}

Box bounds(const Polyline& points) {
  if (points.empty()) return {};
  Box box = {points.front(), points.front()};
  for (const Point point : points) {
    box.lower = {std::min(box.lower.x, point.x), std::min(box.lower.y, point.y)};
    box.upper = {std::max(box.upper.x, point.x), std::max(box.upper.y, point.y)};
  }
  return box;
}

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

bool is_inside(Point point, const Polyline& polygon) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % polygon.size()];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

std::vector<Polyline> triangulated(Polyline polygon) {
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += turn({}, polygon[i], polygon[(i + 1) % polygon.size()]);
  if (area < 0.0) std::reverse(polygon.begin(), polygon.end());

  std::vector<Polyline> triangles;
  while (polygon.size() >= 3) {
    const std::size_t corners = polygon.size();
    std::size_t cut = 0;
    for (; cut < corners; ++cut) {
      const Point a = polygon[(cut + corners - 1) % corners];
      const Point b = polygon[cut];
      const Point c = polygon[(cut + 1) % corners];
      const bool ear = is_ear(polygon, a, b, c);
      if (ear) triangles.push_back({a, b, c});
      if (ear || turn(a, b, c) == 0.0) break; // a corner on a straight side goes without a triangle
    }
    if (cut == corners) throw std::invalid_argument("a polygon whose sides cross");
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(cut));
  }
  return triangles;
}

} // namespace scarp::render
