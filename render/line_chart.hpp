// Curves over a common axis: histories, energies, profiles.
#pragma once

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
};

struct Limits {
  double lower = 0.0;
  double upper = 1.0;
};

struct ChartStyle {
  std::string x_name = {};
  std::string x_unit = {};
  std::string y_name = {};
  std::string y_unit = {};
  std::optional<Limits> x_limits = {}; ///< none: the data, with a little room where it ends
  std::optional<Limits> y_limits = {};
  bool equal_scales = false; ///< one pixel is as long in x as in y
  std::string title = {};
  int width = 1920;       ///< px
  int height = 1200;      ///< px; 0 with equal scales: what the data needs (an even number)
  double font_size = 0.0; ///< px; 0: by the picture's size
};

/// The legend stands in the corner of the plot that no curve enters, else below the plot.  Throws
/// std::invalid_argument if a curve's x and y differ in number, there is nothing to draw or no
/// room, std::runtime_error if drawing fails.
Image render_chart(const std::vector<Curve>& curves, const ChartStyle& style);

/// The same before it has pixels.
Drawing draw_chart(const std::vector<Curve>& curves, const ChartStyle& style);

} // namespace scarp::render
