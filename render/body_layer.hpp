// A frame's body drawn into a plot area.  Internal to render.
#pragma once

#include "render/frame_figure.hpp"
#include "render/plot_area.hpp"

namespace scarp::render {

/// Fills the body with the bands of the style's field, or its points with discs, and outlines it.
void draw_body(Drawing& drawing, const PlotArea& area, const io::Frame& frame,
               const FrameStyle& style, const ColourRange& range);

/// A thick line along the grid's lower side.
void draw_ground(Drawing& drawing, const PlotArea& area, const io::Frame& frame, double font_size);

} // namespace scarp::render
