// The rectangle of a figure in which data is drawn, and its axes.
#pragma once

#include "render/drawing.hpp"

#include <string>
#include <vector>

namespace scarp::render {

struct PlotArea {
  Box world; ///< m, or the chart's own units
  Box pixels;

  Point to_pixels(Point point) const;
  Polyline to_pixels(const Polyline& line) const;
  /// Pixels a unit of x.
  double scale() const { return pixels.width() / world.width(); }
};

/// The largest area with one scale for x and y in `available`, which may be moved: 0 left or
/// bottom, 0.5 centred, 1 right or top.
PlotArea fit_equal(const Box& world, const Box& available, double along_x, double along_y);

struct Axis {
  std::string name = {};
  std::string unit = "m";
  bool labelled = true;                ///< numbers and title, not only ticks
  std::vector<double> ticks = {};      ///< empty: round numbers
  std::vector<std::string> names = {}; ///< of the ticks; empty: the numbers
};

/// The room that axes need outside the plot area, px.
struct Margins {
  double left = 0.0;
  double right = 0.0;
  double bottom = 0.0;
  double top = 0.0;
};

/// Ticks left empty are chosen for the area's size: labels have a font's width between them.
void choose_ticks(const PlotArea& area, Axis& x, Axis& y, double font_size);
/// The ticks must have been chosen.
Margins axis_margins(const Axis& x, const Axis& y, double font_size);
/// Lines on the left and below, ticks outwards, the numbers and the titles.
void draw_axes(Drawing& drawing, const PlotArea& area, const Axis& x, const Axis& y,
               double font_size);

/// The size of words that fit in `room` px: less than `font_size`, but not below what can be read,
/// if they are longer.
double fitting_size(const std::string& text, double room, double font_size);

/// The default size of words, px: 26 in a picture of 1920 x 1080 px, less in a flat one, never
/// below 11.  A height of 0 is not known yet.
double default_font_size(int width, int height);

} // namespace scarp::render
