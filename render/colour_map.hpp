// Perceptually uniform colours (Smith and van der Walt 2015; Nunez et al. 2018), dark to bright.
#pragma once

#include "render/drawing.hpp"

#include <string>
#include <vector>

namespace scarp::render {

enum class ColourMap { viridis, cividis, inferno };

/// Throws std::invalid_argument that lists the names.
ColourMap colour_map(const std::string& name);

/// `part` 0...1 (clamped) along the map, linear between anchors.
Colour colour_at(ColourMap map, double part);

/// The colours of `count` bands: evenly spaced, the map's ends included.
std::vector<Colour> band_colours(ColourMap map, int count);

} // namespace scarp::render
