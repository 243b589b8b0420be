// One frame as a picture: a field in colour bands on the body.
#pragma once

#include "io/frame.hpp"
#include "render/colour_map.hpp"
#include "render/field.hpp"
#include "render/image.hpp"

#include <optional>
#include <span>
#include <string>

namespace scarp::render {

struct FrameStyle {
  Field field = {};
  /// Of the colours; one for all frames of a series comes from common_range().  None: of the frame.
  std::optional<ColourRange> range = {};
  int bands = 12; ///< at most, when there is no range
  ColourMap colours = ColourMap::viridis;
  /// m, x and z; one for all frames of a series comes from common_view().  None: of the frame.
  std::optional<Box> view = {};
  int width = 1920;       ///< px
  int height = 1080;      ///< px; 0: what the body needs (an even number)
  double font_size = 0.0; ///< px; 0: by the picture's size
  std::string title = {};
  int time_digits = 2;      ///< after the point of the time
  bool draw_points = false; ///< discs instead of bands
  int columns = 1;          ///< of the panels of render_panels() and render_field_panels()
};

/// The part of the plane a frame's body needs: from the grid's lower side to a little beyond the
/// body.  Points thrown off do not count.
Box body_view(const io::Frame& frame);
/// The smallest box around both.
Box united(const Box& a, const Box& b);
/// One view for all frames of a series; an empty box without frames.
Box common_view(std::span<const io::Frame> frames);

/// Plane strain: the field is carried to the grid's nodes (node_average(), smoothed by a quadratic
/// B-spline) and drawn in bands on the body (volume fraction at least one half).  3-D: the surface
/// of the body in an oblique view.  Throws std::runtime_error if a column is missing or drawing
/// fails, std::invalid_argument if the style makes no sense.
Image render_frame(const io::Frame& frame, const FrameStyle& style);

} // namespace scarp::render
