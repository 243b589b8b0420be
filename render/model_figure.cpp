#include "render/model_figure.hpp"

#include "render/node_field.hpp"
#include "render/plot_area.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace scarp::render {

namespace {

constexpr Colour body_colour = {196, 205, 214};
constexpr Colour point_colour = {70, 100, 130};

/// A side of the body on the grid's side, from `begin` to `end`, with `outward` a unit vector.
struct Side {
  Point begin;
  Point end;
  Point outward;

  Point at(double along, double out) const {
    const double length = std::hypot(end.x - begin.x, end.y - begin.y);
    const Point unit = {(end.x - begin.x) / length, (end.y - begin.y) / length};
    return {begin.x + along * unit.x + out * outward.x, begin.y + along * unit.y + out * outward.y};
  }
  double length() const { return std::hypot(end.x - begin.x, end.y - begin.y); }
};

void draw_support(Drawing& drawing, const Side& side, Support support, double font) {
  if (support == Support::none) return;
  const Pen pen = {std::max(1.0, 0.08 * font)};
  const Pen wall = {std::max(1.5, 0.14 * font)};
  const double depth = 0.55 * font;
  const double length = side.length();
  double base = 0.0; // of the hatching, outwards
  if (support == Support::roller) {
    const int count = std::max(2, static_cast<int>(length / (3.0 * font)));
    const double radius = 0.28 * font;
    for (int i = 0; i < count; ++i) {
      const Point centre = side.at(length * (i + 0.5) / count, radius);
      drawing.mark(centre, Marker::circle, radius, ink);
      drawing.mark(centre, Marker::circle, radius - pen.width, white);
    }
    base = 2.0 * radius;
  }
  Pen line = wall;
  if (support == Support::frictional) line.dashes = {0.5 * font, 0.25 * font};
  drawing.stroke(Polyline{side.at(0.0, base), side.at(length, base)}, line);
  const int strokes = std::max(3, static_cast<int>(length / (0.6 * font)));
  for (int i = 0; i < strokes; ++i) {
    const double along = length * (i + 0.5) / strokes;
    drawing.stroke(Polyline{side.at(along, base), side.at(along - depth, base + depth)}, pen);
  }
}

/// A dimension line with arrow heads and its number.
void draw_dimension(Drawing& drawing, Point begin, Point end, const std::string& text,
                    double font) {
  const Pen pen = {std::max(1.0, 0.07 * font)};
  const bool upright = begin.x == end.x;
  const double head = 0.5 * font;
  const double half = 0.16 * font;
  drawing.stroke(Polyline{begin, end}, pen);
  const Point along = upright ? Point{0.0, 1.0} : Point{1.0, 0.0};
  const Point across = upright ? Point{1.0, 0.0} : Point{0.0, 1.0};
  const auto arrow = [&](Point tip, double direction) {
    const Point foot = {tip.x + direction * head * along.x, tip.y + direction * head * along.y};
    drawing.fill(Polyline{tip,
                          {foot.x + half * across.x, foot.y + half * across.y},
                          {foot.x - half * across.x, foot.y - half * across.y}},
                 ink);
    const double tick = 0.45 * font;
    drawing.stroke(Polyline{{tip.x - tick * across.x, tip.y - tick * across.y},
                            {tip.x + tick * across.x, tip.y + tick * across.y}},
                   pen);
  };
  arrow(begin, 1.0);
  arrow(end, -1.0);
  Words words;
  words.text = text;
  words.size = font;
  words.upright = upright;
  words.horizontal = upright ? Horizontal::left : Horizontal::centre;
  words.vertical = upright ? Vertical::middle : Vertical::bottom;
  words.position = {0.5 * (begin.x + end.x) + (upright ? 0.35 * font : 0.0),
                    0.5 * (begin.y + end.y) + (upright ? 0.0 : 0.3 * font)};
  drawing.write(words);
}

/// The body's box: half a point spacing around its points.
Box extent(const io::Frame& frame) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box = {{far, far}, {-far, -far}};
  const std::vector<double>& V0 = initial_volumes(frame);
  for (std::size_t p = 0; p < frame.size(); ++p) {
    const double half = 0.5 * std::sqrt(V0[p]);
    const Point at = {frame.position[3 * p], frame.position[3 * p + 2]};
    box.lower = {std::min(box.lower.x, at.x - half), std::min(box.lower.y, at.y - half)};
    box.upper = {std::max(box.upper.x, at.x + half), std::max(box.upper.y, at.y + half)};
  }
  return box;
}

/// The body's highest z on a side of its box.
double highest_at_side(const io::Frame& frame, double x, double bottom) {
  const std::vector<double>& V0 = initial_volumes(frame);
  double highest = bottom;
  for (std::size_t p = 0; p < frame.size(); ++p) {
    const double side = std::sqrt(V0[p]);
    if (std::abs(frame.position[3 * p] - x) < 0.75 * side)
      highest = std::max(highest, frame.position[3 * p + 2] + 0.5 * side);
  }
  return highest;
}

void draw_points(Drawing& drawing, const PlotArea& area, const io::Frame& frame, double outline) {
  const std::vector<double>& V0 = initial_volumes(frame);
  // The outline is what larger dark squares leave to be seen around the light ones.
  const auto squares = [&](double beyond, Colour colour) {
    for (std::size_t p = 0; p < frame.size(); ++p) {
      const double half = 0.5 * std::sqrt(V0[p]) * area.scale() + beyond;
      const Point at = area.to_pixels(Point{frame.position[3 * p], frame.position[3 * p + 2]});
      drawing.fill(Box{{at.x - half, at.y - half}, {at.x + half, at.y + half}}, colour);
    }
  };
  squares(outline, ink);
  squares(0.0, body_colour);
  constexpr double least_spacing = 4.0; // px; closer discs would run together
  for (std::size_t p = 0; p < frame.size(); ++p) {
    const double side = std::sqrt(V0[p]) * area.scale();
    if (side < least_spacing) continue;
    const Point at = area.to_pixels(Point{frame.position[3 * p], frame.position[3 * p + 2]});
    drawing.mark(at, Marker::circle, 0.3 * side, point_colour);
  }
}

/// "0.2 m", with the digits the number has to a thousandth of itself.
std::string metres(double length) {
  const double unit = std::pow(10.0, std::floor(std::log10(length)) - 2.0);
  return fmt::format("{:.6g} m", std::round(length / unit) * unit);
}

} // namespace

Drawing draw_model(const io::Frame& frame, const ModelStyle& style) {
  if (frame.size() == 0) throw std::invalid_argument("a model without points");
  const double font = style.font_size > 0.0
                          ? style.font_size
                          : std::max(11.0, 1.2 * default_font_size(style.width, style.height));
  const Box body = extent(frame);
  double notes_width = 0.0;
  for (const std::string& note : style.notes) {
    Words words;
    words.text = note;
    words.size = font;
    notes_width = std::max(notes_width, text_size(words).x + 2.2 * font);
  }
  const double left = 4.2 * font;
  const double right = (style.right.label.empty() ? 4.0 : 5.6) * font + notes_width;
  const double bottom = (style.bottom.label.empty() ? 2.4 : 3.6) * font;
  const double top = 3.0 * font + (style.title.empty() ? 0.0 : 2.0 * font);
  Box room = {{left, bottom}, {style.width - right, style.height - top}};
  int height = style.height;
  if (height == 0) {
    const double needed = bottom + top + room.width() * body.height() / body.width();
    const double lines = static_cast<double>(style.notes.size()) * 1.6 * font + 2.0 * font;
    height = 2 * static_cast<int>(std::ceil(0.5 * std::max(needed, lines)));
    room.upper.y = height - top;
  }
  if (!(room.width() > font) || !(room.height() > font))
    throw std::invalid_argument(
        fmt::format("a picture of {} x {} px leaves no room for the model", style.width, height));
  const PlotArea area = fit_equal(body, room, 0.5, 0.5);

  Drawing drawing(style.width, height);
  draw_points(drawing, area, frame, std::max(1.0, 0.07 * font));

  const Box& box = area.pixels;
  const double touch = 0.51 * frame.cell_size;
  const double left_top =
      area.to_pixels(Point{0.0, highest_at_side(frame, body.lower.x, body.lower.y)}).y;
  const double right_top =
      area.to_pixels(Point{0.0, highest_at_side(frame, body.upper.x, body.lower.y)}).y;
  Words words;
  words.size = font;
  words.horizontal = Horizontal::centre;
  if (body.lower.y < frame.lower[2] + touch) {
    draw_support(drawing, {box.lower, {box.upper.x, box.lower.y}, {0.0, -1.0}},
                 style.bottom.support, font);
    words.vertical = Vertical::top;
    words.text = style.bottom.label;
    words.position = {0.5 * (box.lower.x + box.upper.x), box.lower.y - 1.4 * font};
    if (!words.text.empty()) drawing.write(words);
  }
  words.upright = true;
  words.vertical = Vertical::middle;
  if (body.lower.x < frame.lower[0] + touch) {
    draw_support(drawing, {{box.lower.x, left_top}, box.lower, {-1.0, 0.0}}, style.left.support,
                 font);
    words.horizontal = Horizontal::right;
    words.text = style.left.label;
    words.position = {box.lower.x - 1.7 * font, 0.5 * (box.lower.y + left_top)};
    if (!words.text.empty()) drawing.write(words);
  }
  double dimension_x = box.upper.x + 1.2 * font;
  if (body.upper.x > frame.upper[0] - touch || style.right.support != Support::none) {
    draw_support(drawing, {{box.upper.x, box.lower.y}, {box.upper.x, right_top}, {1.0, 0.0}},
                 style.right.support, font);
    words.horizontal = Horizontal::left;
    words.text = style.right.label;
    words.position = {box.upper.x + 1.5 * font, 0.5 * (box.lower.y + right_top)};
    if (!words.text.empty()) drawing.write(words);
    dimension_x = box.upper.x + (words.text.empty() ? 1.8 : 3.4) * font;
  }
  draw_dimension(drawing, {box.lower.x, box.upper.y + 1.0 * font},
                 {box.upper.x, box.upper.y + 1.0 * font}, metres(body.width()), font);
  draw_dimension(drawing, {dimension_x, box.lower.y}, {dimension_x, box.upper.y},
                 metres(body.height()), font);

  words = {};
  words.size = 1.1 * font;
  words.bold = true;
  for (const PlaceMark& place : style.places) {
    const Point at = area.to_pixels(place.position);
    drawing.mark(at, Marker::circle, 0.3 * font, {213, 94, 0});
    words.text = place.label;
    words.position = {at.x + 0.4 * font, at.y + 0.3 * font};
    drawing.write(words);
  }
  words = {};
  words.size = font;
  words.vertical = Vertical::top;
  double y = box.upper.y;
  for (const std::string& note : style.notes) {
    words.text = note;
    words.position = {dimension_x + 2.6 * font, y};
    drawing.write(words);
    y -= 1.6 * font;
  }
  if (!style.title.empty()) {
    words.text = style.title;
    words.size = 1.2 * font;
    words.horizontal = Horizontal::centre;
    words.position = {0.5 * (box.lower.x + box.upper.x), height - 0.6 * font};
    drawing.write(words);
  }
  return drawing;
}

Image render_model(const io::Frame& frame, const ModelStyle& style) {
  return rasterize(draw_model(frame, style));
}

} // namespace scarp::render
