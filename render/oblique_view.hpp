// The oblique parallel projection of 3-D figures.
#pragma once

#include "render/plot_area.hpp"

#include <array>

namespace scarp::render {

using Vector = std::array<double, 3>;

struct SolidBox {
  Vector lower; ///< m
  Vector upper; ///< m
};

/// Seen from +x, -y and above: the lower corner is the leftmost of a box, and its edges there and
/// along the lower right are not hidden.
struct ObliqueView {
  PlotArea area; ///< from the projection's plane, in metres, to pixels

  static Vector right(); ///< unit vectors of the picture in the model
  static Vector up();
  static Vector forward(); ///< away from the eye
  static Point project(const Vector& point);
  static Box extent(const SolidBox& box); ///< of the projected box

  Point to_pixels(const Vector& point) const { return area.to_pixels(project(point)); }
};

} // namespace scarp::render
