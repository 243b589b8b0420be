#include "render/chart_layer.hpp"

#include "render/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <stdexcept>

namespace scarp::render {

namespace {

constexpr double names_height = 1.9; // of the spans, in parts of the font's size
constexpr Colour shade = {238, 241, 245};

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

Axis axis(const std::string& name, const std::string& unit, const std::vector<Tick>& ticks) {
  Axis axis = {name, unit};
  for (const Tick& tick : ticks) {
    axis.ticks.push_back(tick.at);
    axis.names.push_back(tick.label);
  }
  return axis;
}

/// Of the family; equal ones count once.
std::vector<double> parameters(const std::vector<Curve>& curves) {
  std::set<double> values;
  for (const Curve& curve : curves)
    if (curve.parameter) values.insert(*curve.parameter);
  return {values.begin(), values.end()};
}

Colour family_colour(const ChartStyle& style, const std::vector<double>& values, double value) {
  constexpr double bright_end = 0.88;
  const double span = values.back() - values.front();
  const double part = span > 0.0 ? (value - values.front()) / span : 0.0;
  return colour_at(style.parameter_colours, bright_end * part);
}

std::vector<Colour> curve_colours(const Chart& chart) {
  constexpr std::array<Colour, 6> colours = {palette::blue,   palette::vermilion, palette::green,
                                             palette::purple, palette::orange,    palette::sky};
  const std::vector<double> values = parameters(chart.curves);
  std::vector<Colour> chosen;
  std::size_t next = 0;
  for (const Curve& curve : chart.curves)
    chosen.push_back(curve.colour      ? *curve.colour
                     : curve.parameter ? family_colour(chart.style, values, *curve.parameter)
                                       : colours[next++ % colours.size()]);
  return chosen;
}

std::vector<PlacedCurve> placed_curves(const Chart& chart, const PlotArea& area) {
  const std::vector<Colour> colours = curve_colours(chart);
  std::vector<PlacedCurve> placed;
  for (const Curve& curve : chart.curves) {
    PlacedCurve item = {&curve, {}, colours[placed.size()]};
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
    placed.push_back(std::move(item));
  }
  return placed;
}

/// The bands lie below everything else.
void draw_spans(Drawing& drawing, const Chart& chart, const PlotArea& area, double font_size) {
  const Box& box = area.pixels;
  Words words;
  words.size = font_size;
  words.horizontal = Horizontal::centre;
  words.vertical = Vertical::middle;
  std::set<double> limits;
  bool shaded = false;
  for (const Span& span : chart.style.spans) {
    shaded = !shaded;
    const double begin = std::max(span.x.lower, area.world.lower.x);
    const double end = std::min(span.x.upper, area.world.upper.x);
    if (begin >= end) continue;
    const Box band = {{area.to_pixels({begin, 0.0}).x, box.lower.y},
                      {area.to_pixels({end, 0.0}).x, box.upper.y}};
    if (shaded) drawing.fill(band, shade);
    words.text = span.name;
    words.position = {0.5 * (band.lower.x + band.upper.x),
                      box.upper.y - 0.5 * names_height * font_size};
    drawing.write(words);
    limits.insert({span.x.lower, span.x.upper});
  }
  const Pen pen = {
      std::max(1.0, 0.06 * font_size), palette::grey, {0.35 * font_size, 0.3 * font_size}};
  for (const double limit : limits) {
    const double at = area.to_pixels({limit, 0.0}).x;
    if (limit > area.world.lower.x && limit < area.world.upper.x)
      drawing.stroke(Polyline{{at, box.lower.y}, {at, box.upper.y}}, pen);
  }
}

void draw_curve(Drawing& drawing, const PlacedCurve& placed, double font_size) {
  const Curve& curve = *placed.curve;
  const Pen pen = curve_pen(curve.line, placed.colour, curve.weight, font_size);
  for (const Polyline& part : placed.parts)
    if (part.size() > 1) drawing.stroke(part, pen);
  const double radius = marker_radius(curve.weight, font_size);
  for (const Polyline& part : placed.parts)
    if (part.size() == 1) drawing.mark(part[0], curve.marker, radius, placed.colour);
}

} // namespace

Box chart_limits(const Chart& chart) {
  const ChartStyle& style = chart.style;
  for (const Curve& curve : chart.curves)
    if (curve.x.size() != curve.y.size())
      throw std::invalid_argument(
          fmt::format("curve '{}' has {} x and {} y", curve.label, curve.x.size(), curve.y.size()));
  for (const Span& span : style.spans)
    if (!(span.x.upper > span.x.lower))
      throw std::invalid_argument(fmt::format("the limits of span '{}' must ascend", span.name));
  const Limits x = style.x_limits ? *style.x_limits : limits_of(chart.curves, &Curve::x);
  const Limits y = style.y_limits ? *style.y_limits : limits_of(chart.curves, &Curve::y);
  const Box limits = {{x.lower, y.lower}, {x.upper, y.upper}};
  if (!(limits.width() > 0.0) || !(limits.height() > 0.0))
    throw std::invalid_argument("a chart's limits must ascend");
  return limits;
}

Legend chart_legend(const Chart& chart) {
  Legend legend;
  const std::vector<Colour> colours = curve_colours(chart);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    if (!curve.label.empty())
      legend.entries.push_back({curve.label, colours[i], curve.line, curve.marker, curve.weight});
  }
  const ChartStyle& style = chart.style;
  const std::vector<double> values = parameters(chart.curves);
  if (!values.empty()) {
    legend.key = ColourKey{style.parameter_name, values, {}};
    if (!style.parameter_unit.empty()) legend.key->title += " (" + style.parameter_unit + ")";
    for (const double value : values)
      legend.key->colours.push_back(family_colour(style, values, value));
  }
  legend.notes = style.notes;
  return legend;
}

PlacedChart place_chart(const Chart& chart, const Box& limits, const Legend& legend,
                        const Box& room, double font_size) {
  const ChartStyle& style = chart.style;
  const double names = style.spans.empty() ? 0.0 : names_height * font_size;
  PlacedChart placed;
  placed.area = style.equal_scales ? fit_equal(limits, room, 0.5, 0.5) : PlotArea{limits, room};
  // The names of the spans stand above the data, unless the limits are given.
  if (!style.y_limits && !style.equal_scales && room.height() > names)
    placed.area.world.upper.y += limits.height() * names / (room.height() - names);
  placed.x = axis(style.x_name, style.x_unit, style.x_ticks);
  placed.y = axis(style.y_name, style.y_unit, style.y_ticks);
  choose_ticks(placed.area, placed.x, placed.y, font_size);
  if (style.equal_scales && limits.lower.x == limits.lower.y && limits.upper.x == limits.upper.y) {
    std::vector<double>& x = placed.x.ticks;
    std::vector<double>& y = placed.y.ticks;
    (x.size() < y.size() ? y : x) = x.size() < y.size() ? x : y; // equal axes look the same
  }
  placed.curves = placed_curves(chart, placed.area);
  if (legend.empty()) return placed;

  Obstacles obstacles;
  for (const PlacedCurve& curve : placed.curves)
    obstacles.lines.insert(obstacles.lines.end(), curve.parts.begin(), curve.parts.end());
  Box free = placed.area.pixels;
  free.upper.y -= names;
  placed.legend_box = free_corner(obstacles, free, legend_size(legend, font_size), font_size);
  return placed;
}

void draw_placed(Drawing& drawing, const Chart& chart, const PlacedChart& placed,
                 double font_size) {
  draw_spans(drawing, chart, placed.area, font_size);
  for (const PlacedCurve& curve : placed.curves) draw_curve(drawing, curve, font_size);
  draw_axes(drawing, placed.area, placed.x, placed.y, font_size);
}

} // namespace scarp::render
