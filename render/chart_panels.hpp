// Several charts in one figure.
#pragma once

#include "render/line_chart.hpp"

#include <vector>

namespace scarp::render {

struct ChartPanelsStyle {
  int columns = 2;
  bool letters = true; ///< a), b), ... before the titles
  /// One below all panels: each label once, and the notes if all charts have the same.  Keys and
  /// other notes stay.
  bool shared_legend = false;
  int width = 1920;       ///< px
  int height = 0;         ///< px; 0: plots three high to four wide, or what equal scales need
  double font_size = 0.0; ///< px; 0: by the picture's size
};

/// The charts row by row, with plots of one size; sizes in the charts' own styles do not count.
/// Throws as draw_chart(), and std::invalid_argument without charts or columns.
Image render_chart_panels(const std::vector<Chart>& charts, const ChartPanelsStyle& style);

/// The same before it has pixels.
Drawing draw_chart_panels(const std::vector<Chart>& charts, const ChartPanelsStyle& style);

} // namespace scarp::render
