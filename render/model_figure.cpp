#include "render/model_figure.hpp"

#include "render/model_layout.hpp"
#include "render/node_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace scarp::render {

namespace {

constexpr Colour point_colour = {70, 100, 130};

void draw_discs(Drawing& drawing, const PlotArea& area, const io::Frame& frame) {
  const std::vector<double>& V0 = initial_volumes(frame);
  constexpr double least_spacing = 4.0; // px; closer discs would run together
  for (std::size_t p = 0; p < frame.size(); ++p) {
    const double side = std::sqrt(V0[p]) * area.scale();
    if (side < least_spacing) continue;
    const Point at = area.to_pixels(Point{frame.position[3 * p], frame.position[3 * p + 2]});
    drawing.mark(at, Marker::circle, 0.3 * side, point_colour);
  }
}

/// The body where no parts are told apart.
void draw_squares(Drawing& drawing, const PlotArea& area, const io::Frame& frame, double outline) {
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
}

void draw_body(Drawing& drawing, const io::Frame& frame, const ModelStyle& style,
               const ModelLayout& plan) {
  const double pen_width = std::max(1.0, 0.07 * plan.font);
  if (style.parts.empty()) {
    draw_squares(drawing, plan.area, frame, pen_width);
    draw_discs(drawing, plan.area, frame);
    return;
  }
  for (std::size_t part = 0; part < style.parts.size(); ++part)
    for (const Polyline& triangle : triangulated(style.parts[part].outline))
      drawing.fill(plan.area.to_pixels(triangle), plan.colours[part]);
  draw_discs(drawing, plan.area, frame);
  for (const Polyline& line : plan.outlines) drawing.stroke(line, {1.3 * pen_width, ink});
}

/// Words over discs stand on a plate of the part's colour.
void write_on_body(Drawing& drawing, const ModelLayout& plan, const Words& words) {
  const Box plate = covered(words);
  const Point middle = {0.5 * (plate.lower.x + plate.upper.x),
                        0.5 * (plate.lower.y + plate.upper.y)};
  for (std::size_t part = 0; part < plan.colours.size(); ++part)
    if (is_inside(middle, plan.outlines[part])) drawing.fill(plate, plan.colours[part]);
  drawing.write(words);
}

void draw_places(Drawing& drawing, const ModelStyle& style, const ModelLayout& plan,
                 Obstacles& obstacles) {
  const double radius = 0.3 * plan.font;
  const double clear = 0.8 * radius;
  for (const PlaceMark& place : style.places) {
    const Point at = plan.area.to_pixels(place.position);
    obstacles.boxes.push_back({{at.x - clear, at.y - clear}, {at.x + clear, at.y + clear}});
  }
  Words words;
  words.size = 1.1 * plan.font;
  words.bold = true;
  for (const PlaceMark& place : style.places) {
    const Point at = plan.area.to_pixels(place.position);
    words.text = place.label;
    const Words placed = beside(at, words, obstacles, plan.font);
    write_on_body(drawing, plan, placed);
    drawing.mark(at, Marker::circle, radius, palette::vermilion);
    obstacles.boxes.push_back(covered(placed));
  }
}

} // namespace

Drawing draw_model(const io::Frame& frame, const ModelStyle& style) {
  const ModelLayout plan = model_layout(frame, style);
  Drawing drawing(style.width, plan.height);
  draw_body(drawing, frame, style, plan);
  Obstacles obstacles = {plan.outlines};
  for (const HeldSide& held : plan.sides) {
    draw_support(drawing, held.side, held.support, plan.font);
    if (held.words.text.empty()) continue;
    drawing.write(held.words);
    obstacles.boxes.push_back(covered(held.words));
  }
  for (const DimensionLine& line : plan.dimensions) {
    draw_dimension(drawing, line, plan.font);
    obstacles.lines.push_back({line.from, line.begin, line.end, line.to});
    obstacles.boxes.push_back(covered(line.words));
  }
  if (!plan.legend.empty()) draw_legend(drawing, plan.legend, plan.legend_box, plan.font);
  for (const Words& note : plan.notes) drawing.write(note);
  for (const Words& label : plan.part_labels) {
    write_on_body(drawing, plan, label);
    obstacles.boxes.push_back(covered(label));
  }
  draw_places(drawing, style, plan, obstacles);
  if (!style.title.empty()) {
    Words words;
    words.text = style.title;
    words.size = 1.2 * plan.font;
    words.horizontal = Horizontal::centre;
    words.vertical = Vertical::top;
    words.position = {0.5 * (plan.area.pixels.lower.x + plan.area.pixels.upper.x),
                      plan.height - 0.6 * plan.font};
    drawing.write(words);
  }
  return drawing;
}

Image render_model(const io::Frame& frame, const ModelStyle& style) {
  return rasterize(draw_model(frame, style));
}

} // namespace scarp::render
