#include "render/legend.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scarp::render {

namespace {

// In parts of the font's size.
constexpr double line_height = 1.45;
constexpr double sample_length = 2.6;
constexpr double gap = 0.6;

} // namespace

Pen curve_pen(const DrawnCurve& drawn, double font_size) {
  Pen pen = {std::max(1.2, 0.11 * font_size), drawn.colour};
  if (drawn.curve->line == LineKind::dashed) pen.dashes = {0.55 * font_size, 0.32 * font_size};
  if (drawn.curve->line == LineKind::dotted) pen.dashes = {0.12 * font_size, 0.2 * font_size};
  return pen;
}

double marker_radius(double font_size) { return std::max(2.5, 0.24 * font_size); }

std::optional<Point> legend_size(const std::vector<DrawnCurve>& curves, double font_size) {
  double widest = 0.0;
  double lines = 0.0;
  for (const DrawnCurve& drawn : curves) {
    if (drawn.curve->label.empty()) continue;
    Words words;
    words.text = drawn.curve->label;
    words.size = font_size;
    widest = std::max(widest, text_size(words).x);
    lines += 1.0;
  }
  if (lines == 0.0) return std::nullopt;
  return Point{widest + (sample_length + 2.0 * gap) * font_size, lines * line_height * font_size};
}

std::optional<Box> free_corner(const std::vector<DrawnCurve>& curves, const Box& area, Point size,
                               double font_size) {
  const double clear = 0.6 * font_size;
  const double left = area.lower.x + clear;
  const double right = area.upper.x - size.x - clear;
  const double low = area.lower.y + clear;
  const double high = area.upper.y - size.y - 0.2 * font_size;
  if (right < left || high < low) return std::nullopt;
  const std::array<Point, 4> corners = {
      Point{right, high}, {right, low}, {left, high}, {left, low}};
  for (const Point corner : corners) {
    const Box box = {{corner.x - clear, corner.y - clear},
                     {corner.x + size.x + clear, corner.y + size.y + clear}};
    const bool entered = std::any_of(curves.begin(), curves.end(), [&](const DrawnCurve& drawn) {
      return std::any_of(drawn.parts.begin(), drawn.parts.end(), [&](const Polyline& part) {
        return !clipped(part, box).empty() || (part.size() == 1 && box.contains(part[0]));
      });
    });
    if (!entered) return Box{corner, {corner.x + size.x, corner.y + size.y}};
  }
  return std::nullopt;
}

void draw_legend(Drawing& drawing, const std::vector<DrawnCurve>& curves, const Box& box,
                 double font_size) {
  double y = box.upper.y - 0.5 * line_height * font_size;
  for (const DrawnCurve& drawn : curves) {
    if (drawn.curve->label.empty()) continue;
    const double begin = box.lower.x;
    const double end = begin + sample_length * font_size;
    if (drawn.curve->line != LineKind::none)
      drawing.stroke(Polyline{{begin, y}, {end, y}}, curve_pen(drawn, font_size));
    drawing.mark({0.5 * (begin + end), y}, drawn.curve->marker, marker_radius(font_size),
                 drawn.colour);
    Words words;
    words.position = {end + gap * font_size, y};
    words.text = drawn.curve->label;
    words.size = font_size;
    words.vertical = Vertical::middle;
    drawing.write(words);
    y -= line_height * font_size;
  }
}

} // namespace scarp::render
