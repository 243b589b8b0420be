// Points, lines and boxes in the plane: of the model in metres, of a picture in pixels.
#pragma once

#include <vector>

namespace scarp::render {

struct Point {
  double x = 0.0;
  double y = 0.0; ///< the model's z in metres, or up in a picture

  bool operator==(const Point&) const = default;
};

using Polyline = std::vector<Point>;

struct Box {
  Point lower;
  Point upper;

  double width() const { return upper.x - lower.x; }
  double height() const { return upper.y - lower.y; }
  bool contains(Point point) const {
    return point.x >= lower.x && point.x <= upper.x && point.y >= lower.y && point.y <= upper.y;
  }
};

/// The box with `by` more on each side.
Box grown(const Box& box, double by);

/// The smallest box around all points; empty without points.
Box bounds(const Polyline& points);

/// The parts of a line inside a box (Liang-Barsky); a part has at least two points.
std::vector<Polyline> clipped(const Polyline& line, const Box& box);

/// The part of a convex polygon inside a box (Sutherland-Hodgman); empty if there is none.
Polyline clipped_polygon(Polyline polygon, const Box& box);

/// Whether the point lies in a closed polygon (even-odd rule).
bool is_inside(Point point, const Polyline& polygon);

/// Triangles that tile a polygon whose sides do not cross, in either direction (ear clipping).
/// Throws std::invalid_argument if its sides cross.
std::vector<Polyline> triangulated(Polyline polygon);

} // namespace scarp::render
