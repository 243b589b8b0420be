#include "render/model_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace scarp::render {

namespace {

double distance(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// `a` moved by `length` along `direction`.
Point moved(Point a, Point direction, double length) {
  return {a.x + length * direction.x, a.y + length * direction.y};
}

Point unit(Point from, Point to) {
  const double length = distance(from, to);
  if (length == 0.0) return {1.0, 0.0};
  return {(to.x - from.x) / length, (to.y - from.y) / length};
}

void draw_arrow_head(Drawing& drawing, Point tip, Point towards, double length, double half) {
  const Point along = unit(tip, towards);
  const Point foot = moved(tip, along, length);
  drawing.fill(Polyline{tip,
                        {foot.x - half * along.y, foot.y + half * along.x},
                        {foot.x + half * along.y, foot.y - half * along.x}},
               ink);
}

} // namespace

double Side::length() const { return distance(begin, end); }

Point Side::at(double along, double out) const {
  return moved(moved(begin, unit(begin, end), along), outward, out);
}

void draw_support(Drawing& drawing, const Side& side, Support support, double font_size) {
  if (support == Support::none) return;
  const Pen pen = {std::max(1.0, 0.08 * font_size)};
  const Pen wall = {std::max(1.5, 0.14 * font_size)};
  const double depth = 0.55 * font_size;
  const double length = side.length();
  double base = 0.0; // of the hatching, outwards
  if (support == Support::roller) {
    const int count = std::max(2, static_cast<int>(length / (3.0 * font_size)));
    const double radius = 0.28 * font_size;
    for (int i = 0; i < count; ++i) {
      const Point centre = side.at(length * (i + 0.5) / count, radius);
      drawing.mark(centre, Marker::circle, radius, ink);
      drawing.mark(centre, Marker::circle, radius - pen.width, white);
    }
    base = 2.0 * radius;
  }
  Pen line = wall;
  if (support == Support::frictional) line.dashes = {0.5 * font_size, 0.25 * font_size};
  drawing.stroke(Polyline{side.at(0.0, base), side.at(length, base)}, line);
  const int strokes = std::max(3, static_cast<int>(length / (0.6 * font_size)));
  for (int i = 0; i < strokes; ++i) {
    const double along = length * (i + 0.5) / strokes;
    drawing.stroke(Polyline{side.at(along, base), side.at(along - depth, base + depth)}, pen);
  }
}

DimensionLine dimension_line(Point begin, Point end, Point outward, const std::string& label,
                             double font_size) {
  constexpr double straight = 1e-3; // of a right angle: along the picture's sides
  DimensionLine line = {begin, end, begin, end, {}};
  Words& words = line.words;
  words.text = label;
  words.size = font_size;
  // Across a short arrow the words would meet its limits.
  words.upright =
      std::abs(outward.y) < straight && text_size(words).x < distance(begin, end) - 0.6 * font_size;
  words.position = moved({0.5 * (begin.x + end.x), 0.5 * (begin.y + end.y)}, outward,
                         (words.upright ? 0.35 : 0.3) * font_size);
  words.horizontal = std::abs(outward.x) < straight ? Horizontal::centre
                     : outward.x > 0.0              ? Horizontal::left
                                                    : Horizontal::right;
  words.vertical = std::abs(outward.y) < straight ? Vertical::middle
                   : outward.y > 0.0              ? Vertical::bottom
                                                  : Vertical::top;
  return line;
}

DimensionLine dimension_line(const DimensionMark& mark, const PlotArea& area, double font_size) {
  const Point from = area.to_pixels(mark.from);
  const Point to = area.to_pixels(mark.to);
  const Point along = unit(from, to);
  const Point left = {-along.y, along.x};
  Point outward = mark.away < 0.0 ? Point{along.y, -along.x} : left;
  constexpr double level = 1e-3;
  const bool below = outward.y < -level || (outward.y < level && outward.x < 0.0);
  if (mark.away == 0.0 && below) outward = {-outward.x, -outward.y};
  const double away = mark.away * font_size;
  const std::string label = mark.label.empty() ? metres(distance(mark.from, mark.to)) : mark.label;
  DimensionLine line =
      dimension_line(moved(from, left, away), moved(to, left, away), outward, label, font_size);
  line.from = from;
  line.to = to;
  return line;
}

Box bounds(const DimensionLine& line) {
  const Box words = covered(line.words);
  return bounds(Polyline{line.begin, line.end, words.lower, words.upper});
}

void draw_dimension(Drawing& drawing, const DimensionLine& line, double font_size) {
  const Pen pen = {std::max(1.0, 0.07 * font_size)};
  const double length = distance(line.begin, line.end);
  const double head = std::min(0.5 * font_size, 0.4 * length);
  const double beyond = 0.45 * font_size;
  drawing.stroke(Polyline{line.begin, line.end}, pen);
  draw_arrow_head(drawing, line.begin, line.end, head, 0.32 * head);
  draw_arrow_head(drawing, line.end, line.begin, head, 0.32 * head);
  const Point along = unit(line.begin, line.end);
  const Point across = {-along.y, along.x};
  const auto draw_limit = [&](Point measured, Point tip) {
    if (distance(measured, tip) < beyond) {
      drawing.stroke(Polyline{moved(tip, across, -beyond), moved(tip, across, beyond)}, pen);
      return;
    }
    const Point outward = unit(measured, tip);
    const double gap = 0.25 * font_size;
    drawing.stroke(Polyline{moved(measured, outward, gap), moved(tip, outward, beyond)}, pen);
  };
  draw_limit(line.from, line.begin);
  draw_limit(line.to, line.end);
  drawing.write(line.words);
}

std::string metres(double length) {
  const double last_digit = std::pow(10.0, std::floor(std::log10(length)) - 2.0);
  return fmt::format("{:.6g} m", std::round(length / last_digit) * last_digit);
}

Words beside(Point at, Words words, const Obstacles& obstacles, double font_size) {
  const double near_x = 0.4 * font_size;
  const double near_y = 0.3 * font_size;
  struct Place {
    int x; // right or left of the mark, or centred on it
    int y;
  };
  constexpr std::array<Place, 8> places = {Place{1, 1}, {-1, 1}, {1, -1}, {-1, -1},
                                           {1, 0},      {-1, 0}, {0, 1},  {0, -1}};
  std::optional<Words> first;
  for (const double far : {1.0, 2.0}) {
    for (const Place place : places) {
      words.horizontal = static_cast<Horizontal>(1 - place.x);
      words.vertical = static_cast<Vertical>(1 - place.y);
      // Straight above and beside the mark the words must clear its radius.
      const double reach = place.x == 0 || place.y == 0 ? 1.6 * far : far;
      words.position = {at.x + reach * place.x * near_x, at.y + reach * place.y * near_y};
      if (!first) first = words;
      if (!obstacles.meet(grown(covered(words), 0.12 * font_size))) return words;
    }
  }
  return *first;
}

std::optional<Words> within(const Polyline& polygon, Words words, const Obstacles& obstacles,
                            double font_size) {
  const Box box = bounds(polygon);
  Point middle;
  double area = 0.0;
  for (const Polyline& triangle : triangulated(polygon)) {
    const Point a = triangle[0];
    const Point b = triangle[1];
    const Point c = triangle[2];
    const double part = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    middle = {middle.x + part * (a.x + b.x + c.x) / 3.0, middle.y + part * (a.y + b.y + c.y) / 3.0};
    area += part;
  }
  middle = {middle.x / area, middle.y / area};

  Obstacles all = obstacles;
  all.lines.push_back(polygon);
  all.lines.back().push_back(polygon.front());
  words.horizontal = Horizontal::centre;
  words.vertical = Vertical::middle;
  constexpr int steps = 12; // each way, so that the middle itself is tried
  std::optional<Point> best;
  for (int i = -steps; i <= steps; ++i) {
    for (int k = -steps; k <= steps; ++k) {
      const Point at = {middle.x + 0.5 * i * box.width() / steps,
                        middle.y + 0.5 * k * box.height() / steps};
      if (best && distance(at, middle) >= distance(*best, middle)) continue;
      words.position = at;
      if (is_inside(at, polygon) && !all.meet(grown(covered(words), 0.2 * font_size))) best = at;
    }
  }
  if (!best) return std::nullopt;
  words.position = *best;
  return words;
}

} // namespace scarp::render
