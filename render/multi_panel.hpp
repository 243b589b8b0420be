// Several frames in one figure.
#pragma once

#include "render/frame_figure.hpp"

#include <span>

namespace scarp::render {

/// Panels a), b), ... row by row in `style.columns` with one view, one range and one colour bar;
/// each bears its time.  Plane strain only.  `style.height` 0 gives every panel the height its body
/// needs.
/// Throws as render_frame(), and std::invalid_argument without frames.
Image render_panels(std::span<const io::Frame> frames, const FrameStyle& style);

/// The same before it has pixels.
Drawing draw_panels(std::span<const io::Frame> frames, const FrameStyle& style);

} // namespace scarp::render
