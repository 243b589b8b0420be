// A 3-D frame as a picture.
#pragma once

#include "render/frame_figure.hpp"

namespace scarp::render {

/// The surface of the body (volume fraction one half on the grid's nodes) with the field in colour
/// bands, in an oblique view of parallel rays.  Throws as render_frame().
Image render_solid(const io::Frame& frame, const FrameStyle& style);

} // namespace scarp::render
