// From a VTK renderer to an Image.  Internal to render.
#pragma once

#include "render/image.hpp"

class vtkRenderer;

namespace scarp::render {

/// Draws off-screen with four samples a pixel, in a window of its own.  Throws std::runtime_error
/// if there is no OpenGL, std::invalid_argument if the size is not within 1...16384 px.
Image draw(vtkRenderer& renderer, int width, int height);

} // namespace scarp::render
