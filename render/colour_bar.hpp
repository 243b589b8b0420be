// The legend of a banded colour field.
#pragma once

#include "render/colour_map.hpp"
#include "render/field.hpp"

#include <string>

namespace scarp::render {

struct ColourBar {
  ColourRange range;
  ColourMap colours = ColourMap::viridis;
  std::string label;     ///< without the unit
  std::string unit;      ///< may be empty
  bool category = false; ///< one named band a number, no scale
};

/// The room it needs across, px: a horizontal bar's height, an upright bar's width, with its labels
/// and title.
double bar_thickness(const ColourBar& bar, bool upright, double font_size);

/// Fills `box`, whose thickness is bar_thickness(); the bar runs along its whole length.
void draw_bar(Drawing& drawing, const ColourBar& bar, const Box& box, bool upright,
              double font_size);

} // namespace scarp::render
