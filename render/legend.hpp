// The legend of a chart.  Internal to render.
#pragma once

#include "render/line_chart.hpp"
#include "render/plot_area.hpp"

#include <optional>
#include <vector>

namespace scarp::render {

/// A curve ready to draw, in pixels.
struct DrawnCurve {
  const Curve* curve;
  std::vector<Polyline> parts;
  Colour colour;
};

Pen curve_pen(const DrawnCurve& drawn, double font_size);
double marker_radius(double font_size);

/// px; nothing if no curve has a label.
std::optional<Point> legend_size(const std::vector<DrawnCurve>& curves, double font_size);

/// The corner of `area` whose box of `size` no curve enters, tried from the upper right
/// clockwise but the lower left last.
std::optional<Box> free_corner(const std::vector<DrawnCurve>& curves, const Box& area, Point size,
                               double font_size);

void draw_legend(Drawing& drawing, const std::vector<DrawnCurve>& curves, const Box& box,
                 double font_size);

} // namespace scarp::render
