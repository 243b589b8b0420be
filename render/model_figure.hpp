// A plane-strain model before the run: its points, supports and dimensions.
#pragma once

#include "io/frame.hpp"
#include "render/drawing.hpp"
#include "render/image.hpp"

#include <string>
#include <vector>

namespace scarp::render {

/// What holds the grid's side: nothing, rollers (free along it: symmetry), hatching (fixed), or
/// hatching with dashes (friction).
enum class Support { none, roller, fixed, frictional };

struct SideMark {
  Support support = Support::none;
  std::string label = {}; ///< such as "symmetry"
};

/// A named place in the model, such as a monitor.
struct PlaceMark {
  Point position; ///< m
  std::string label;
};

struct ModelStyle {
  SideMark left = {};
  SideMark right = {};
  SideMark bottom = {};
  std::vector<PlaceMark> places = {};
  std::vector<std::string> notes = {}; ///< lines beside the model, such as its material
  std::string title = {};
  int width = 1600;       ///< px
  int height = 0;         ///< px; 0: what the model needs (an even number)
  double font_size = 0.0; ///< px; 0: by the picture's size
};

/// Points as discs (a grey area when they would touch), outline, supports on the sides of the grid
/// that the body touches, and the body's length and height.  Throws as render_frame().
Image render_model(const io::Frame& frame, const ModelStyle& style);

/// The same before it has pixels.
Drawing draw_model(const io::Frame& frame, const ModelStyle& style);

} // namespace scarp::render
