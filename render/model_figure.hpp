// A plane-strain model before the run: its points, supports and dimensions.
#pragma once

#include "io/frame.hpp"
#include "render/drawing.hpp"
#include "render/image.hpp"

#include <optional>
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

/// A double arrow between two points.
struct DimensionMark {
  Point from;             ///< m
  Point to;               ///< m
  std::string label = {}; ///< empty: the distance, such as "25 m"
  /// How far the arrow stands off, to the left of the way from `from` to `to`, in sizes of the
  /// font, or farther where the words of a support stand; thin lines lead there.  The label is on
  /// the far side, at 0 above or to the right.
  double away = 0.0;
};

/// A part of the body, such as a surcharge.
struct PartMark {
  Polyline outline;       ///< m; its sides do not cross
  std::string label = {}; ///< inside if there is room, else with a sample above the notes
  std::optional<Colour> colour = {}; ///< none: the next of a few light ones
};

struct ModelStyle {
  SideMark left = {};
  SideMark right = {};
  SideMark bottom = {};
  std::vector<PlaceMark> places = {};
  std::vector<DimensionMark> dimensions = {}; ///< none: the body's length and height
  std::vector<PartMark> parts = {};           ///< none: all points alike
  /// Lines in a corner that the body leaves free, else beside it, such as its material.
  std::vector<std::string> notes = {};
  std::string title = {};
  int width = 1600;       ///< px
  int height = 0;         ///< px; 0: what the model needs (an even number)
  double font_size = 0.0; ///< px; 0: by the picture's size
};

/// Points as discs (a plain area when they would touch), outlines, supports on the sides of the
/// grid that the body touches, dimensions; labels of places keep clear of lines and of each other.
/// Throws as render_frame(), and std::invalid_argument if the sides of a part cross.
Image render_model(const io::Frame& frame, const ModelStyle& style);

/// The same before it has pixels.
Drawing draw_model(const io::Frame& frame, const ModelStyle& style);

} // namespace scarp::render
