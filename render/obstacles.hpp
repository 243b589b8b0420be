// What words in a picture must keep clear of.  Internal to render.
#pragma once

#include "render/geometry.hpp"

#include <algorithm>
#include <vector>

namespace scarp::render {

/// Lengths in pixels.
struct Obstacles {
  std::vector<Polyline> lines = {}; ///< one of a single point is a mark
  std::vector<Box> boxes = {};

  bool meet(const Box& box) const {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const Polyline& line) {
                         return line.size() == 1 ? box.contains(line[0])
                                                 : !clipped(line, box).empty();
                       }) ||
           std::any_of(boxes.begin(), boxes.end(), [&](const Box& other) {
             return other.lower.x < box.upper.x && box.lower.x < other.upper.x &&
                    other.lower.y < box.upper.y && box.lower.y < other.upper.y;
           });
  }
};

} // namespace scarp::render
