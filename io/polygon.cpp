#include "io/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::io {
namespace {

using Corner = std::array<double, 2>;

// Twice the signed area of the triangle: positive if c lies left of the line from a to b.
double side(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool in_box(const Corner& a, const Corner& b, const Corner& c) {
  return c[0] >= std::min(a[0], b[0]) && c[0] <= std::max(a[0], b[0]) &&
         c[1] >= std::min(a[1], b[1]) && c[1] <= std::max(a[1], b[1]);
}

bool on_segment(const Corner& a, const Corner& b, const Corner& c) {
  return side(a, b, c) == 0.0 && in_box(a, b, c);
}

bool segments_meet(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  const bool crosses = side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
  return crosses || on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) ||
         on_segment(c, d, b);
}

// Neighbours share the corner b.
bool folds_back(const Corner& a, const Corner& b, const Corner& c) {
  return on_segment(a, b, c) || on_segment(b, c, a);
}

} // namespace

double area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += side(polygon[0], polygon[i], polygon[i + 1]);
  return std::abs(twice) / 2.0;
}

bool is_flat(const Polygon& polygon) {
  const auto distance = [&](const Corner& c) {
    return std::hypot(c[0] - polygon[0][0], c[1] - polygon[0][1]);
  };
  const Corner& far = *std::ranges::max_element(polygon, {}, distance);
  constexpr double flat = 1e-12; // height of the polygon as a part of its length
  return std::ranges::all_of(polygon, [&](const Corner& c) {
    return std::abs(side(polygon[0], far, c)) <= flat * distance(far) * distance(far);
  });
}

std::optional<std::pair<std::size_t, std::size_t>> crossing_edges(const Polygon& polygon) {
  const std::size_t count = polygon.size();
  const auto corner = [&](std::size_t i) -> const Corner& { return polygon[i % count]; };
  for (std::size_t i = 0; i < count; ++i) {
    if (folds_back(corner(i), corner(i + 1), corner(i + 2))) return std::pair(i, (i + 1) % count);
    for (std::size_t j = i + 2; j < count; ++j) {
      const bool neighbours = i == 0 && j + 1 == count;
      if (!neighbours && segments_meet(corner(i), corner(i + 1), corner(j), corner(j + 1)))
        return std::pair(i, j);
    }
  }
  return std::nullopt;
}

double distance(const Polygon& polygon, const std::array<double, 2>& point) {
  bool inside = false;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    const double ex = b[0] - a[0], ez = b[1] - a[1];
    const double px = point[0] - a[0], pz = point[1] - a[1];
    const double t = std::clamp((ex * px + ez * pz) / (ex * ex + ez * ez), 0.0, 1.0);
    least = std::min(least, std::hypot(px - t * ex, pz - t * ez));
    if ((a[1] > point[1]) != (b[1] > point[1]) && px < ex * pz / ez) inside = !inside;
  }
  return inside ? 0.0 : least;
}

} // namespace scarp::io
