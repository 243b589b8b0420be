#include "render/solid_figure.hpp"

#include "render/body.hpp"
#include "render/colour_bar.hpp"
#include "render/oblique_view.hpp"
#include "render/plot_area.hpp"
#include "render/solid_surface.hpp"
#include "render/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace scarp::render {

namespace {

/// The ground under the body and the air above it, without points thrown off.
SolidBox body_box(const io::Frame& frame, const std::optional<Box>& view) {
  SolidBox box = {frame.lower, frame.lower};
  const std::vector<std::size_t> thrown = thrown_off(frame);
  auto next_thrown = thrown.begin();
  for (std::size_t p = 0; p < frame.size(); ++p) {
    if (next_thrown != thrown.end() && *next_thrown == p) {
      ++next_thrown;
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      box.upper[axis] = std::max(box.upper[axis], frame.position[3 * p + axis]);
  }
  constexpr double air = 1.04;
  for (std::size_t axis = 0; axis < 3; ++axis)
    box.upper[axis] =
        std::min(box.lower[axis] + air * (box.upper[axis] - box.lower[axis]), frame.upper[axis]);
  if (view) {
    box.lower = {view->lower.x, box.lower[1], view->lower.y};
    box.upper = {view->upper.x, box.upper[1], view->upper.y};
  }
  return box;
}

/// One of the three axes: an edge of the box and the direction of its ticks, both in the picture.
struct Edge {
  std::size_t axis;
  std::array<double, 3> start; ///< m
  Point outwards;              ///< unit vector
  Words words;                 ///< alignment of the labels
  const char* name;
};

void draw_edge(Drawing& drawing, const ObliqueView& view, const SolidBox& box, const Edge& edge,
               double font) {
  const Pen pen = {std::max(1.0, 0.07 * font)};
  std::array<double, 3> end = edge.start;
  end[edge.axis] = box.upper[edge.axis];
  const Point first = view.to_pixels(edge.start);
  const Point last = view.to_pixels(end);
  drawing.stroke(Polyline{first, last}, pen);
  const double length = std::hypot(last.x - first.x, last.y - first.y);
  const int most = std::clamp(static_cast<int>(length / (4.5 * font)), 2, 8);
  const std::vector<double> values = ticks(box.lower[edge.axis], box.upper[edge.axis], most);
  const std::vector<std::string> labels = tick_labels(values, common_power(values));
  Words words = edge.words;
  words.size = font;
  double widest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::array<double, 3> at = edge.start;
    at[edge.axis] = values[i];
    const Point on = view.to_pixels(at);
    const auto out = [&](double distance) {
      return Point{on.x + distance * edge.outwards.x, on.y + distance * edge.outwards.y};
    };
    drawing.stroke(Polyline{on, out(0.32 * font)}, pen);
    words.position = out(0.55 * font);
    words.text = labels[i];
    widest = std::max(widest, text_size(words).x);
    drawing.write(words);
  }
  const double away = (0.9 + 1.1 * std::abs(edge.outwards.y)) * font +
                      std::abs(edge.outwards.x) * (widest + 0.8 * font);
  words.text = fmt::format("{} {}", edge.name, unit_label("m", common_power(values)));
  words.position = {0.5 * (first.x + last.x) + away * edge.outwards.x,
                    0.5 * (first.y + last.y) + away * edge.outwards.y};
  drawing.write(words);
}

void draw_edges(Drawing& drawing, const ObliqueView& view, const SolidBox& box, double font) {
  Words below;
  below.horizontal = Horizontal::centre;
  below.vertical = Vertical::top;
  Words right;
  right.vertical = Vertical::middle;
  Words left;
  left.horizontal = Horizontal::right;
  left.vertical = Vertical::middle;
  const std::array<double, 3> corner = box.lower;
  const std::array<double, 3> far_corner = {box.upper[0], box.lower[1], box.lower[2]};
  draw_edge(drawing, view, box, {0, corner, {0.0, -1.0}, below, "x"}, font);
  draw_edge(drawing, view, box, {1, far_corner, {1.0, 0.0}, right, "y"}, font);
  draw_edge(drawing, view, box, {2, corner, {-1.0, 0.0}, left, "z"}, font);
}

} // namespace

Image render_solid(const io::Frame& frame, const FrameStyle& style) {
  if (style.width < 1 || style.height < 0 || style.bands < 1)
    throw std::invalid_argument(fmt::format("a picture of {} x {} px with {} colours", style.width,
                                            style.height, style.bands));
  const double font =
      style.font_size > 0.0 ? style.font_size : default_font_size(style.width, style.height);
  const SolidBox box = body_box(frame, style.view);
  const ColourRange range =
      style.range ? *style.range : common_range({&frame, 1}, style.field, style.bands);
  const ColourBar bar = {range, style.colours, field_label(frame, style.field),
                         field_unit(style.field), is_category(style.field)};
  const double thickness = bar_thickness(bar, false, font);
  const double top = (style.title.empty() ? 2.6 : 4.4) * font;
  const double below = thickness + 5.4 * font;
  const double beside = 6.5 * font;

  const Box extent = ObliqueView::extent(box);
  int height = style.height;
  if (height == 0) {
    const double needed =
        top + below + (style.width - 2.0 * beside) * extent.height() / extent.width();
    height = 2 * static_cast<int>(std::ceil(0.5 * needed));
  }
  const Box room = {{beside, below}, {style.width - beside, height - top}};
  if (!(room.width() > font) || !(room.height() > font))
    throw std::invalid_argument(
        fmt::format("a picture of {} x {} px leaves no room for the body", style.width, height));
  const ObliqueView view = {fit_equal(extent, room, 0.5, 0.5)};

  Drawing drawing(style.width, height);
  drawing.backdrop = draw_surface(frame, field_values(frame, style.field), box, view, range,
                                  style.colours, style.width, height);
  draw_edges(drawing, view, box, font);
  const double bar_width = 0.6 * style.width;
  const double bar_top = std::max(view.area.pixels.lower.y - 4.6 * font, thickness + 0.7 * font);
  const double bar_left = 0.5 * (style.width - bar_width);
  draw_bar(drawing, bar, {{bar_left, bar_top - thickness}, {bar_left + bar_width, bar_top}}, false,
           font);
  Words words;
  words.size = 1.08 * font;
  words.position = {view.area.pixels.lower.x, view.area.pixels.upper.y + 0.8 * font};
  words.text = fmt::format("t = {:.{}f} s", frame.time, style.time_digits);
  drawing.write(words);
  if (!style.title.empty()) {
    words.text = style.title;
    words.size = 1.25 * font;
    words.horizontal = Horizontal::centre;
    words.position = {0.5 * style.width, view.area.pixels.upper.y + 2.4 * font};
    drawing.write(words);
  }
  return rasterize(drawing);
}

} // namespace scarp::render
