// The surface of a 3-D body as pixels.  Internal to render.
#pragma once

#include "io/frame.hpp"
#include "render/colour_map.hpp"
#include "render/field.hpp"
#include "render/oblique_view.hpp"

#include <vector>

namespace scarp::render {

/// The 0.5 contour of the volume fraction on the grid's nodes, closed at the grid's sides, coloured
/// by the values of the points carried to the nodes; under it the ground, box's lower side.
Image draw_surface(const io::Frame& frame, const std::vector<double>& values, const SolidBox& box,
                   const ObliqueView& view, const ColourRange& range, ColourMap colours, int width,
                   int height);

} // namespace scarp::render
