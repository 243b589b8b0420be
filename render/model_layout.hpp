// Where the parts of a model figure stand.  Internal to render.
#pragma once

#include "render/legend.hpp"
#include "render/model_marks.hpp"

#include <vector>

namespace scarp::render {

inline constexpr Colour body_colour = {196, 205, 214}; ///< also of the first part

/// A side of the body that touches the grid's.
struct HeldSide {
  Side side;
  Support support;
  Words words; ///< no text: unnamed
};

/// Lengths in pixels.
struct ModelLayout {
  double font = 0.0;
  int height = 0;                 ///< of the picture
  Box body;                       ///< m
  PlotArea area;                  ///< of the body
  std::vector<Polyline> outlines; ///< of the parts, else of the body
  std::vector<Colour> colours;    ///< of the parts
  std::vector<HeldSide> sides;
  std::vector<DimensionLine> dimensions;
  std::vector<Words> part_labels;
  std::vector<Words> notes;
  Legend legend; ///< of the parts that are too small for their labels
  Box legend_box;
};

/// Throws std::invalid_argument as draw_model().
ModelLayout model_layout(const io::Frame& frame, const ModelStyle& style);

} // namespace scarp::render
