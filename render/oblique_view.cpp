#include "render/oblique_view.hpp"

#include <algorithm>
#include <cmath>

namespace scarp::render {

namespace {

constexpr double eye_turn = 0.45;  // rad, of the eye from -y towards +x
constexpr double eye_raise = 0.42; // rad, of the eye above the ground

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

} // namespace

Vector ObliqueView::right() { return {std::cos(eye_turn), std::sin(eye_turn), 0.0}; }

Vector ObliqueView::up() {
  return {-std::sin(eye_raise) * std::sin(eye_turn), std::sin(eye_raise) * std::cos(eye_turn),
          std::cos(eye_raise)};
}

Vector ObliqueView::forward() {
  return {-std::cos(eye_raise) * std::sin(eye_turn), std::cos(eye_raise) * std::cos(eye_turn),
          -std::sin(eye_raise)};
}

Point ObliqueView::project(const Vector& point) { return {dot(right(), point), dot(up(), point)}; }

Box ObliqueView::extent(const SolidBox& box) {
  Box all = {project(box.lower), project(box.lower)};
  for (const double x : {box.lower[0], box.upper[0]}) {
    for (const double y : {box.lower[1], box.upper[1]}) {
      for (const double z : {box.lower[2], box.upper[2]}) {
        const Point at = project({x, y, z});
        all.lower = {std::min(all.lower.x, at.x), std::min(all.lower.y, at.y)};
        all.upper = {std::max(all.upper.x, at.x), std::max(all.upper.y, at.y)};
      }
    }
  }
  return all;
}

} // namespace scarp::render
