// Curves over a common axis: histories, energies, profiles.
#pragma once

#include "render/colour_map.hpp"
#include "render/drawing.hpp"
#include "render/image.hpp"

#include <optional>
#include <string>
#include <vector>

namespace scarp::render {

/// Colours that stay apart for colour-blind readers and in grey (Okabe and Ito 2008).
namespace palette {
inline constexpr Colour blue = {0, 114, 178};
inline constexpr Colour vermilion = {213, 94, 0};
inline constexpr Colour green = {0, 158, 115};
inline constexpr Colour purple = {204, 121, 167};
inline constexpr Colour orange = {230, 159, 0};
inline constexpr Colour sky = {86, 180, 233};
inline constexpr Colour grey = {120, 120, 120};
} // namespace palette

enum class LineKind { none, solid, dashed, dotted };

/// Points that are not numbers break the line.
struct Curve {
  std::string label = {}; ///< empty: not in the legend
  std::vector<double> x;
  std::vector<double> y;
  std::optional<Colour> colour = {}; ///< none: the next of the palette
  LineKind line = LineKind::solid;
  Marker marker = Marker::none;
  double weight = 1.0; ///< width of the line and size of the markers, times the usual
  /// The value that tells this curve from others of a family: gives its colour.
  std::optional<double> parameter = {};
};

struct Limits {
  double lower = 0.0;
  double upper = 1.0;
};

/// A named part of the x axis, such as a stage of a slide.
struct Span {
  std::string name; ///< short: it stands in one line between the limits
  Limits x;
};

/// A place on an axis and what it is called there.
struct Tick {
  double at = 0.0;
  std::string label;
};

struct ChartStyle {
  std::string x_name = {};
  std::string x_unit = {};
  std::string y_name = {};
  std::string y_unit = {};
  std::optional<Limits> x_limits = {}; ///< none: the data, with a little room where it ends
  std::optional<Limits> y_limits = {};
  std::vector<Tick> x_ticks = {}; ///< empty: round numbers
  std::vector<Tick> y_ticks = {};
  bool equal_scales = false; ///< one pixel is as long in x as in y
  /// Light bands behind the curves, every other one shaded, with dashed limits and the names above
  /// the data.
  std::vector<Span> spans = {};
  /// What the curves with a parameter differ in; a key in the legend tells colours and values.
  std::string parameter_name = {};
  std::string parameter_unit = {};
  ColourMap parameter_colours = ColourMap::viridis; ///< without its brightest end: faint on white
  std::vector<std::string> notes = {};              ///< lines of text at the end of the legend
  std::string title = {};
  int width = 1920;       ///< px
  int height = 1200;      ///< px; 0 with equal scales: what the data needs (an even number)
  double font_size = 0.0; ///< px; 0: by the picture's size
};

struct Chart {
  std::vector<Curve> curves;
  ChartStyle style = {};
};

/// The legend stands in the corner of the plot that no curve enters, else below the plot.  Throws
/// std::invalid_argument if a curve's x and y differ in number, limits do not ascend, there is
/// nothing to draw or no room, std::runtime_error if drawing fails.
Image render_chart(const std::vector<Curve>& curves, const ChartStyle& style);

/// The same before it has pixels.
Drawing draw_chart(const std::vector<Curve>& curves, const ChartStyle& style);

} // namespace scarp::render
