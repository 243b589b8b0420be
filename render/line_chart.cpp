#include "render/line_chart.hpp"

#include "render/legend.hpp"
#include "render/plot_area.hpp"
#include "render/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace scarp::render {

namespace {

/// Where the data ends on a round number or at 0 the axis ends there too, else a little later.
Limits limits_of(const std::vector<Curve>& curves, const std::vector<double> Curve::*member) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Curve& curve : curves) {
    for (const double value : curve.*member) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(high >= low)) throw std::invalid_argument("a chart without a point");
  if (high == low) return {low - 0.5, high + 0.5};
  constexpr double room = 0.05;
  const double span = high - low;
  const double step = round_step(span / 10.0);
  const auto is_round = [&](double value) {
    return std::abs(value / step - std::round(value / step)) < 1e-6;
  };
  return {is_round(low) ? low : low - room * span, is_round(high) ? high : high + room * span};
}

std::vector<DrawnCurve> drawn_curves(const std::vector<Curve>& curves, const PlotArea& area) {
  constexpr std::array<Colour, 6> colours = {palette::blue,   palette::vermilion, palette::green,
                                             palette::purple, palette::orange,    palette::sky};
  std::vector<DrawnCurve> drawn;
  std::size_t next = 0;
  for (const Curve& curve : curves) {
    DrawnCurve item = {&curve, {}, curve.colour ? *curve.colour : colours[next % colours.size()]};
    if (!curve.colour) ++next;
    Polyline part;
    const auto end_part = [&] {
      if (curve.line != LineKind::none)
        for (const Polyline& inside : clipped(part, area.world))
          item.parts.push_back(area.to_pixels(inside));
      part.clear();
    };
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const Point point = {curve.x[i], curve.y[i]};
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
        end_part();
        continue;
      }
      if (curve.marker != Marker::none && area.world.contains(point))
        item.parts.push_back({area.to_pixels(point)});
      part.push_back(point);
    }
    end_part();
    drawn.push_back(std::move(item));
  }
  return drawn;
}

void draw_curve(Drawing& drawing, const DrawnCurve& drawn, double font_size) {
  const Pen pen = curve_pen(drawn, font_size);
  for (const Polyline& part : drawn.parts)
    if (part.size() > 1) drawing.stroke(part, pen);
  for (const Polyline& part : drawn.parts)
    if (part.size() == 1)
      drawing.mark(part[0], drawn.curve->marker, marker_radius(font_size), drawn.colour);
}

struct Layout {
  PlotArea area;
  Axis x;
  Axis y;
  int height = 0; ///< px
  std::optional<Box> legend;
};

/// `below` is the room for a legend below the plot, px.
Layout layout(const ChartStyle& style, const Box& world, double font, double below) {
  Layout plan;
  plan.area = {world,
               {{0, 0}, {0.85 * style.width, 0.8 * std::max(style.height, style.width / 4)}}};
  for (int round = 0; round < 2; ++round) { // margins depend on ticks, ticks on the size
    plan.x = {style.x_name, style.x_unit};
    plan.y = {style.y_name, style.y_unit};
    choose_ticks(plan.area, plan.x, plan.y, font);
    const Margins margins = axis_margins(plan.x, plan.y, font);
    constexpr double edge = 0.7; // of the font's size
    const double above = margins.top + edge * font + (style.title.empty() ? 0.0 : 2.0 * font);
    Box room;
    room.lower = {margins.left + edge * font, margins.bottom + edge * font + below};
    room.upper.x = style.width - std::max(edge * font, margins.right + 0.7 * font);
    plan.height = style.height;
    if (style.equal_scales && style.height == 0) {
      const double needed = room.lower.y + above + room.width() * world.height() / world.width();
      plan.height = 2 * static_cast<int>(std::ceil(0.5 * needed));
    }
    room.upper.y = plan.height - above;
    if (!(room.width() > 4.0 * font) || !(room.height() > 2.0 * font))
      throw std::invalid_argument(
          fmt::format("a chart of {} x {} px leaves no room for curves", style.width, plan.height));
    plan.area = style.equal_scales ? fit_equal(world, room, 0.5, 0.5) : PlotArea{world, room};
  }
  return plan;
}

} // namespace

Drawing draw_chart(const std::vector<Curve>& curves, const ChartStyle& style) {
  for (const Curve& curve : curves)
    if (curve.x.size() != curve.y.size())
      throw std::invalid_argument(
          fmt::format("curve '{}' has {} x and {} y", curve.label, curve.x.size(), curve.y.size()));
  if (style.height <= 0 && !style.equal_scales)
    throw std::invalid_argument("a chart's height follows from its width only with equal scales");
  const Limits x = style.x_limits ? *style.x_limits : limits_of(curves, &Curve::x);
  const Limits y = style.y_limits ? *style.y_limits : limits_of(curves, &Curve::y);
  const Box world = {{x.lower, y.lower}, {x.upper, y.upper}};
  if (!(world.width() > 0.0) || !(world.height() > 0.0))
    throw std::invalid_argument("a chart's limits must ascend");
  const double font =
      style.font_size > 0.0 ? style.font_size : default_font_size(style.width, style.height);

  Layout plan = layout(style, world, font, 0.0);
  std::vector<DrawnCurve> drawn = drawn_curves(curves, plan.area);
  if (const auto size = legend_size(drawn, font)) {
    plan.legend = free_corner(drawn, plan.area.pixels, *size, font);
    if (!plan.legend) {
      plan = layout(style, world, font, size->y + 0.8 * font);
      drawn = drawn_curves(curves, plan.area);
      const double left = 0.5 * (plan.area.pixels.lower.x + plan.area.pixels.upper.x - size->x);
      const double low = 0.7 * font;
      plan.legend = Box{{left, low}, {left + size->x, low + size->y}};
    }
  }

  Drawing drawing(style.width, plan.height);
  for (const DrawnCurve& curve : drawn) draw_curve(drawing, curve, font);
  draw_axes(drawing, plan.area, plan.x, plan.y, font);
  if (plan.legend) draw_legend(drawing, drawn, *plan.legend, font);
  if (!style.title.empty()) {
    Words words;
    words.text = style.title;
    words.size = 1.2 * font;
    words.horizontal = Horizontal::centre;
    words.position = {0.5 * (plan.area.pixels.lower.x + plan.area.pixels.upper.x),
                      plan.area.pixels.upper.y + 0.8 * font};
    drawing.write(words);
  }
  return drawing;
}

Image render_chart(const std::vector<Curve>& curves, const ChartStyle& style) {
  return rasterize(draw_chart(curves, style));
}

} // namespace scarp::render
