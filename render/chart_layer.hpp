// A chart drawn into a part of a picture.  Internal to render.
#pragma once

#include "render/legend.hpp"
#include "render/line_chart.hpp"
#include "render/plot_area.hpp"

#include <optional>
#include <vector>

namespace scarp::render {

/// A curve in pixels: lines, and markers as lines of one point.
struct PlacedCurve {
  const Curve* curve;
  std::vector<Polyline> parts;
  Colour colour;
};

/// A chart for one place of its plot; lent the chart's curves.
struct PlacedChart {
  PlotArea area;
  Axis x;
  Axis y;
  std::vector<PlacedCurve> curves;
  std::optional<Box> legend_box; ///< none: no legend, or no corner is free for it
};

/// What the axes show.  Throws std::invalid_argument as draw_chart().
Box chart_limits(const Chart& chart);

/// The curves with a label, the key of the family, the notes.
Legend chart_legend(const Chart& chart);

/// In a plot within `room`, px; `limits` from chart_limits().
PlacedChart place_chart(const Chart& chart, const Box& limits, const Legend& legend,
                        const Box& room, double font_size);

/// All but title and legend.
void draw_placed(Drawing& drawing, const Chart& chart, const PlacedChart& placed, double font_size);

} // namespace scarp::render
