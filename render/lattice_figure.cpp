#include "render/lattice_figure.hpp"

#include "render/legend.hpp"
#include "render/plot_area.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scarp::render {

namespace {

constexpr Colour grid_colour = {110, 116, 122};
constexpr double lattice_edge = 0.7; // in parts of the font's size
constexpr double grid_weight = 0.8;
constexpr double side_weight = 1.6;

Colour colour_of(const LatticePiece& piece) {
  return piece.cut ? palette::vermilion : palette::blue;
}

Colour tint(Colour colour) {
  constexpr double towards_white = 0.78;
  return mixed(colour, white, towards_white);
}

void stroke_clipped(Drawing& drawing, const PlotArea& area, const Polyline& line, const Pen& pen) {
  for (const Polyline& part : clipped(line, area.world)) drawing.stroke(area.to_pixels(part), pen);
}

void draw_pieces(Drawing& drawing, const PlotArea& area, const std::vector<LatticePiece>& pieces,
                 double font) {
  const double line = std::max(1.0, 0.05 * font);
  for (const LatticePiece& piece : pieces) {
    drawing.fill(area.to_pixels(clipped_polygon(piece.outline, area.world)),
                 tint(colour_of(piece)));
    Polyline closed = piece.outline;
    closed.push_back(closed.front());
    stroke_clipped(drawing, area, closed, {line, mixed(colour_of(piece), white, 0.35)});
  }
}

void draw_grid(Drawing& drawing, const PlotArea& area, const LatticeStyle& style, double font) {
  const Pen pen = curve_pen(LineKind::solid, grid_colour, grid_weight, font);
  const double h = style.cell_size;
  const Box& view = area.world;
  const auto first = [h](double node, double from) {
    return node + h * std::ceil((from - node) / h);
  };
  for (double x = first(style.node.x, view.lower.x); x <= view.upper.x; x += h)
    stroke_clipped(drawing, area, {{x, view.lower.y}, {x, view.upper.y}}, pen);
  for (double z = first(style.node.y, view.lower.y); z <= view.upper.y; z += h)
    stroke_clipped(drawing, area, {{view.lower.x, z}, {view.upper.x, z}}, pen);
}

void draw_points(Drawing& drawing, const PlotArea& area, const std::vector<LatticePiece>& pieces,
                 double font) {
  for (const LatticePiece& piece : pieces)
    if (area.world.contains(piece.point))
      drawing.mark(area.to_pixels(piece.point), Marker::circle, marker_radius(1.0, font),
                   colour_of(piece));
}

Legend legend_of(const std::vector<LatticePiece>& pieces, const LatticeStyle& style) {
  Legend legend;
  for (const bool cut : {false, true}) {
    const auto found = std::find_if(pieces.begin(), pieces.end(),
                                    [cut](const LatticePiece& piece) { return piece.cut == cut; });
    if (found != pieces.end())
      legend.entries.push_back({.label = cut ? style.cut_label : style.full_label,
                                .colour = colour_of(*found),
                                .marker = Marker::circle,
                                .fill = tint(colour_of(*found))});
  }
  legend.entries.push_back({.label = style.grid_label,
                            .colour = grid_colour,
                            .line = LineKind::solid,
                            .weight = grid_weight});
  if (!style.sides.empty())
    legend.entries.push_back(
        {.label = style.side_label, .line = LineKind::solid, .weight = side_weight});
  return legend;
}

} // namespace

Drawing draw_lattice(const std::vector<LatticePiece>& pieces, const LatticeStyle& style) {
  if (!(style.view.width() > 0.0) || !(style.view.height() > 0.0))
    throw std::invalid_argument("the view is empty");
  constexpr double most_cells = 1000.0; // across; the lines would run together
  if (!(style.cell_size * most_cells > std::max(style.view.width(), style.view.height())))
    throw std::invalid_argument(fmt::format("a cell of {} m", style.cell_size));
  std::vector<LatticePiece> seen;
  for (const LatticePiece& piece : pieces)
    if (clipped_polygon(piece.outline, style.view).size() >= 3) seen.push_back(piece);
  if (seen.empty()) throw std::invalid_argument("no piece of the lattice is in the view");

  const double font =
      style.font_size > 0.0 ? style.font_size : default_font_size(style.width, style.height);
  Legend legend = legend_of(seen, style);
  spread(legend, style.width - 2.0 * lattice_edge * font, font);
  const Point legend_room = legend_size(legend, font);

  PlotArea area = {style.view, {{0, 0}, {0.8 * style.width, 0.8 * style.width}}};
  Axis x;
  Axis z;
  int height = style.height;
  for (int round = 0; round < 2; ++round) { // margins depend on ticks, ticks on the size
    x = {"x", "m"};
    z = {"z", "m"};
    choose_ticks(area, x, z, font);
    const Margins margins = axis_margins(x, z, font);
    const double above = margins.top + (lattice_edge + (style.title.empty() ? 0.0 : 2.0)) * font;
    Box room;
    room.lower = {margins.left + lattice_edge * font,
                  margins.bottom + legend_room.y + (2.0 * lattice_edge + 0.3) * font};
    room.upper.x = style.width - std::max(lattice_edge * font, margins.right + 0.7 * font);
    if (style.height == 0) {
      const double needed =
          room.lower.y + above + room.width() * style.view.height() / style.view.width();
      height = 2 * static_cast<int>(std::ceil(0.5 * needed));
    }
    room.upper.y = height - above;
    if (!(room.width() > 4.0 * font) || !(room.height() > 2.0 * font))
      throw std::invalid_argument(fmt::format(
          "a picture of {} x {} px leaves no room for the lattice", style.width, height));
    area = fit_equal(style.view, room, 0.5, 0.5);
  }

  Drawing drawing(style.width, height);
  draw_pieces(drawing, area, seen, font);
  draw_grid(drawing, area, style, font);
  for (const Polyline& side : style.sides)
    stroke_clipped(drawing, area, side, curve_pen(LineKind::solid, ink, side_weight, font));
  draw_points(drawing, area, seen, font);
  draw_axes(drawing, area, x, z, font);
  const double left = 0.5 * (style.width - legend_room.x);
  const double low = lattice_edge * font;
  draw_legend(drawing, legend, {{left, low}, {left + legend_room.x, low + legend_room.y}}, font);
  if (!style.title.empty()) {
    Words words;
    words.text = style.title;
    words.size = 1.2 * font;
    words.horizontal = Horizontal::centre;
    words.position = {0.5 * (area.pixels.lower.x + area.pixels.upper.x),
                      area.pixels.upper.y + 0.8 * font};
    drawing.write(words);
  }
  return drawing;
}

Image render_lattice(const std::vector<LatticePiece>& pieces, const LatticeStyle& style) {
  return rasterize(draw_lattice(pieces, style));
}

} // namespace scarp::render
