// Several fields of one frame in one figure.
#pragma once

#include "render/frame_figure.hpp"

#include <optional>
#include <string>
#include <vector>

namespace scarp::render {

/// One panel, with a colour bar of its own.
struct FieldPanel {
  Field field = {};
  std::string title = {};                ///< empty: the field's label
  std::optional<ColourRange> range = {}; ///< none: of the frame
  ColourMap colours = ColourMap::viridis;
};

/// Panels a), b), ... row by row in `style.columns` with one view.  Of the style, field, range and
/// colours do not count.  Plane strain only.  Throws as render_frame(), and std::invalid_argument
/// without fields.
Image render_field_panels(const io::Frame& frame, const std::vector<FieldPanel>& fields,
                          const FrameStyle& style);

/// The same before it has pixels.
Drawing draw_field_panels(const io::Frame& frame, const std::vector<FieldPanel>& fields,
                          const FrameStyle& style);

} // namespace scarp::render
