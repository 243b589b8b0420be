#include "render/model_layout.hpp"

#include "render/contour.hpp"
#include "render/node_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace scarp::render {

namespace {

constexpr double note_height = 1.6; // of a line, in parts of the font's size

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

bool held_on_the_right(const io::Frame& frame, const ModelStyle& style, const Box& body) {
  const double touch = 0.51 * frame.cell_size;
  return body.upper.x > frame.upper[0] - touch || style.right.support != Support::none;
}

std::vector<HeldSide> held_sides(const io::Frame& frame, const ModelStyle& style,
                                 const ModelLayout& plan) {
  const Box& box = plan.area.pixels;
  const Box& body = plan.body;
  const double touch = 0.51 * frame.cell_size;
  const auto top_at = [&](double x) {
    return plan.area.to_pixels(Point{x, highest_at_side(frame, x, body.lower.y)});
  };
  std::vector<HeldSide> sides;
  // `away`: of the words from the side, in parts of the font's size.
  const auto add = [&](const Side& side, const SideMark& mark, double away, Words words) {
    words.text = mark.label;
    words.size =
        mark.label.empty() ? plan.font : fitting_size(mark.label, side.length(), plan.font);
    words.position = side.at(0.5 * side.length(), away * plan.font);
    sides.push_back({side, mark.support, words});
  };
  Words words;
  if (body.lower.y < frame.lower[2] + touch) {
    words.horizontal = Horizontal::centre;
    words.vertical = Vertical::top;
    add({box.lower, {box.upper.x, box.lower.y}, {0.0, -1.0}}, style.bottom, 1.4, words);
  }
  words.upright = true;
  words.vertical = Vertical::middle;
  if (body.lower.x < frame.lower[0] + touch) {
    words.horizontal = Horizontal::right;
    add({top_at(body.lower.x), box.lower, {-1.0, 0.0}}, style.left, 1.7, words);
  }
  if (held_on_the_right(frame, style, body)) {
    words.horizontal = Horizontal::left;
    add({{box.upper.x, box.lower.y}, top_at(body.upper.x), {1.0, 0.0}}, style.right, 1.5, words);
  }
  return sides;
}

/// How far the support and its words on the right reach, px.
double right_reach(const io::Frame& frame, const ModelStyle& style, const ModelLayout& plan) {
  if (!held_on_the_right(frame, style, plan.body)) return 1.2 * plan.font;
  return (style.right.label.empty() ? 1.8 : 3.4) * plan.font;
}

/// The mark farther out where words of a support stand.
DimensionMark pushed_out(DimensionMark mark, const ModelLayout& plan) {
  Obstacles obstacles;
  for (const HeldSide& held : plan.sides)
    if (!held.words.text.empty())
      obstacles.boxes.push_back(grown(covered(held.words), 0.4 * plan.font));
  if (mark.away == 0.0) return mark;
  const double step = mark.away > 0.0 ? 0.25 : -0.25;
  constexpr int most = 20;
  for (int i = 0; i < most && obstacles.meet(bounds(dimension_line(mark, plan.area, plan.font)));
       ++i)
    mark.away += step;
  return mark;
}

bool are_parallel(const DimensionMark& a, const DimensionMark& b) {
  const Point u = {a.to.x - a.from.x, a.to.y - a.from.y};
  const Point v = {b.to.x - b.from.x, b.to.y - b.from.y};
  const double along = u.x * v.x + u.y * v.y;
  return along > 0.0 && std::abs(u.x * v.y - u.y * v.x) < 1e-6 * along;
}

/// Parallel marks of one distance stay in line.
std::vector<DimensionMark> pushed_out(const std::vector<DimensionMark>& marks,
                                      const ModelLayout& plan) {
  std::vector<DimensionMark> pushed = marks;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double away = pushed_out(marks[i], plan).away;
    for (std::size_t j = 0; j < marks.size(); ++j)
      if (marks[j].away == marks[i].away && are_parallel(marks[i], marks[j]) &&
          std::abs(away) > std::abs(pushed[j].away))
        pushed[j].away = away;
  }
  return pushed;
}

std::vector<DimensionLine> dimension_lines(const io::Frame& frame, const ModelStyle& style,
                                           const ModelLayout& plan) {
  const Box& box = plan.area.pixels;
  std::vector<DimensionLine> lines;
  for (const DimensionMark& mark : pushed_out(style.dimensions, plan))
    lines.push_back(dimension_line(mark, plan.area, plan.font));
  if (!lines.empty()) return lines;
  const double above = box.upper.y + 1.0 * plan.font;
  const double beside = box.upper.x + right_reach(frame, style, plan);
  return {dimension_line({box.lower.x, above}, {box.upper.x, above}, {0.0, 1.0},
                         metres(plan.body.width()), plan.font),
          dimension_line({beside, box.lower.y}, {beside, box.upper.y}, {1.0, 0.0},
                         metres(plan.body.height()), plan.font)};
}

std::vector<Polyline> outlines(const io::Frame& frame, const ModelStyle& style,
                               const PlotArea& area) {
  std::vector<Polyline> lines;
  for (const PartMark& part : style.parts) {
    lines.push_back(area.to_pixels(part.outline));
    lines.back().push_back(lines.back().front());
  }
  if (lines.empty())
    for (const Polyline& line : contour_lines(volume_fraction(frame), body_level))
      lines.push_back(area.to_pixels(line));
  return lines;
}

/// Labels inside the parts, or where these are too small entries of the legend.
void label_parts(const ModelStyle& style, ModelLayout& plan) {
  plan.legend = {};
  plan.part_labels.clear();
  Obstacles obstacles;
  for (const DimensionLine& line : plan.dimensions) obstacles.boxes.push_back(covered(line.words));
  for (const PlaceMark& place : style.places)
    obstacles.lines.push_back({plan.area.to_pixels(place.position)});
  Words words;
  words.size = plan.font;
  for (std::size_t part = 0; part < style.parts.size(); ++part) {
    words.text = style.parts[part].label;
    if (words.text.empty()) continue;
    const Polyline polygon = plan.area.to_pixels(style.parts[part].outline);
    if (const auto inside = within(polygon, words, obstacles, plan.font))
      plan.part_labels.push_back(*inside);
    else
      plan.legend.entries.push_back({.label = words.text, .fill = plan.colours[part]});
  }
}

/// Of the legend and the notes below it.
Point words_size(const ModelLayout& plan) {
  Point size = legend_size(plan.legend, plan.font);
  for (const Words& note : plan.notes) {
    size.x = std::max(size.x, text_size(note).x);
    size.y += note_height * plan.font;
  }
  return size;
}

void place_words(ModelLayout& plan, Point upper_left) {
  const Point size = legend_size(plan.legend, plan.font);
  plan.legend_box = {{upper_left.x, upper_left.y - size.y}, {upper_left.x + size.x, upper_left.y}};
  double y = upper_left.y - size.y;
  for (Words& note : plan.notes) {
    note.position = {upper_left.x, y};
    y -= note_height * plan.font;
  }
}

/// A corner of the body's box without points or lines.
std::optional<Box> corner_for_words(const io::Frame& frame, const ModelLayout& plan) {
  Obstacles obstacles;
  obstacles.lines = plan.outlines;
  for (std::size_t p = 0; p < frame.size(); ++p)
    obstacles.lines.push_back(
        {plan.area.to_pixels(Point{frame.position[3 * p], frame.position[3 * p + 2]})});
  for (const DimensionLine& line : plan.dimensions) obstacles.boxes.push_back(bounds(line));
  return free_corner(obstacles, plan.area.pixels, words_size(plan), plan.font);
}

/// With room for words of the size `beside`, px, to the right of everything; returns the upper left
/// corner of that room.
Point place_body(const io::Frame& frame, const ModelStyle& style, ModelLayout& plan, Point beside) {
  const double font = plan.font;
  const bool measured = style.dimensions.empty();
  const double titled = style.title.empty() ? 0.0 : 2.0 * font;
  Margins margins = {4.2 * font, right_reach(frame, style, plan) + (measured ? 2.2 : 0.8) * font,
                     (style.bottom.label.empty() ? 2.4 : 3.6) * font,
                     (measured ? 3.0 : 1.2) * font};
  // The reach of dimensions depends on the scale, which depends on their reach.
  for (int round = 0; round < 3; ++round) {
    Box room = {{margins.left, margins.bottom},
                {style.width - margins.right - beside.x, style.height - margins.top - titled}};
    plan.height = style.height;
    if (style.height == 0) {
      const double needed = margins.bottom + margins.top + titled +
                            room.width() * plan.body.height() / plan.body.width();
      plan.height = 2 * static_cast<int>(std::ceil(0.5 * std::max(needed, beside.y)));
      room.upper.y = plan.height - margins.top - titled;
    }
    if (!(room.width() > font) || !(room.height() > font))
      throw std::invalid_argument(fmt::format(
          "a picture of {} x {} px leaves no room for the model", style.width, plan.height));
    plan.area = fit_equal(plan.body, room, 0.5, 0.5);
    plan.sides = held_sides(frame, style, plan);
    plan.dimensions = dimension_lines(frame, style, plan);
    const Box& box = plan.area.pixels;
    for (const DimensionLine& line : plan.dimensions) {
      const Box reach = bounds(line);
      const double edge = 0.5 * font;
      margins.left = std::max(margins.left, box.lower.x - reach.lower.x + edge);
      margins.right = std::max(margins.right, reach.upper.x - box.upper.x + edge);
      margins.bottom = std::max(margins.bottom, box.lower.y - reach.lower.y + edge);
      margins.top = std::max(margins.top, reach.upper.y - box.upper.y + edge);
    }
  }
  plan.outlines = outlines(frame, style, plan.area);
  label_parts(style, plan);
  return {plan.area.pixels.upper.x + margins.right + 0.4 * font, plan.area.pixels.upper.y};
}

} // namespace

ModelLayout model_layout(const io::Frame& frame, const ModelStyle& style) {
  constexpr std::array<Colour, 4> light = {body_colour, Colour{242, 208, 150},
                                           Colour{176, 216, 196}, Colour{224, 190, 208}};
  if (frame.size() == 0) throw std::invalid_argument("a model without points");
  ModelLayout plan;
  plan.font = style.font_size > 0.0
                  ? style.font_size
                  : std::max(11.0, 1.2 * default_font_size(style.width, style.height));
  plan.body = extent(frame);
  for (const PartMark& part : style.parts)
    plan.colours.push_back(part.colour.value_or(light[plan.colours.size() % light.size()]));
  for (const std::string& note : style.notes) {
    Words words;
    words.text = note;
    words.size = plan.font;
    words.vertical = Vertical::top;
    plan.notes.push_back(words);
  }
  // Less room for the body may send more labels to the legend.
  for (Point beside;;) {
    Point corner = place_body(frame, style, plan, beside);
    const Point size = words_size(plan);
    if (size.y == 0.0) return plan;
    const auto free = corner_for_words(frame, plan);
    const Point needed = {size.x + 2.2 * plan.font, size.y + 2.0 * plan.font};
    if (free) corner = {free->lower.x, free->upper.y};
    if (free || (needed.x <= beside.x && needed.y <= beside.y)) {
      place_words(plan, corner);
      return plan;
    }
    beside = {std::max(beside.x, needed.x), std::max(beside.y, needed.y)};
  }
}

} // namespace scarp::render
