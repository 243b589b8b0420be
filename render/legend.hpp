// The legend of a figure.  Internal to render.
#pragma once

#include "render/line_chart.hpp"
#include "render/obstacles.hpp"

#include <optional>
#include <string>
#include <vector>

namespace scarp::render {

/// A label with a sample of what it names.
struct LegendEntry {
  std::string label;
  Colour colour = ink; ///< of the line, the marker and the frame of a filled sample
  LineKind line = LineKind::none;
  Marker marker = Marker::none;
  double weight = 1.0;
  std::optional<Colour> fill = {};
};

/// The colours of a family of curves side by side, with values of its parameter.
struct ColourKey {
  std::string title;
  std::vector<double> values; ///< ascending
  std::vector<Colour> colours;
};

/// From top to bottom: the entries, column by column in `columns`, the key, the notes.
struct Legend {
  std::vector<LegendEntry> entries = {};
  std::optional<ColourKey> key = {};
  std::vector<std::string> notes = {};
  std::size_t columns = 1;
  bool below = false; ///< below a plot there is room: the key lies, the notes stand apart

  bool empty() const { return entries.empty() && !key && notes.empty(); }
};

Pen curve_pen(LineKind line, Colour colour, double weight, double font_size);
double marker_radius(double weight, double font_size);

/// px
Point legend_size(const Legend& legend, double font_size);
/// As few rows of entries as fit in `width` px.
void spread(Legend& legend, double width, double font_size);

/// The corner of `area` whose box of `size` meets nothing, tried from the upper right clockwise but
/// the lower left last.
std::optional<Box> free_corner(const Obstacles& obstacles, const Box& area, Point size,
                               double font_size);

void draw_legend(Drawing& drawing, const Legend& legend, const Box& box, double font_size);

} // namespace scarp::render
