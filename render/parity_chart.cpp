#include "render/parity_chart.hpp"

#include "render/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::render {

namespace {

constexpr double thin = 0.6; // weight of guide lines

Limits limits_of(const std::vector<double>& values) {
  Limits limits = {std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    limits.lower = std::min(limits.lower, value);
    limits.upper = std::max(limits.upper, value);
  }
  return limits;
}

/// From round number to round number with a little room, from 0 if the values come near it.
Limits round_limits(Limits limits) {
  constexpr double near = 0.5; // of the far end
  constexpr double room = 0.04;
  const double air = room * (limits.upper - limits.lower);
  if (!(air > 0.0)) return {limits.lower - 0.5, limits.upper + 0.5};
  const bool from_zero = limits.lower >= 0.0 && limits.lower <= near * limits.upper;
  const double lower = from_zero ? 0.0 : limits.lower - air;
  const double upper = limits.upper + air;
  const double step = round_step((upper - lower) / 8.0);
  return {step * std::floor(lower / step), step * std::ceil(upper / step)};
}

Curve dots(const std::vector<double>& x, const std::vector<double>& y) {
  return {.x = x,
          .y = y,
          .colour = palette::blue,
          .line = LineKind::none,
          .marker = Marker::circle,
          .weight = 0.9};
}

/// y = slope x
Curve guide(const std::string& label, Limits x, double slope, Colour colour, LineKind line) {
  return {.label = label,
          .x = {x.lower, x.upper},
          .y = {slope * x.lower, slope * x.upper},
          .colour = colour,
          .line = line,
          .weight = thin};
}

} // namespace

Chart parity_chart(const std::vector<double>& reference, const std::vector<double>& computed,
                   const ParityStyle& style) {
  std::vector<double> all = reference;
  all.insert(all.end(), computed.begin(), computed.end());
  const Limits limits = round_limits(limits_of(all));
  Chart chart;
  chart.curves.push_back(guide("1 : 1", limits, 1.0, ink, LineKind::solid));
  if (style.tolerance) {
    const double part = *style.tolerance;
    chart.curves.push_back(guide(fmt::format("±{:.3g} %", 100.0 * part), limits, 1.0 + part,
                                 palette::grey, LineKind::dashed));
    chart.curves.push_back(guide("", limits, 1.0 - part, palette::grey, LineKind::dashed));
  }
  chart.curves.push_back(dots(reference, computed));
  chart.style = {.x_name = style.reference,
                 .x_unit = style.unit,
                 .y_name = style.computed,
                 .y_unit = style.unit,
                 .x_limits = limits,
                 .y_limits = limits,
                 .equal_scales = true,
                 .notes = style.notes,
                 .title = style.quantity};
  return chart;
}

Chart residual_chart(const std::vector<double>& fitted, const std::vector<double>& residual,
                     const ResidualStyle& style) {
  const Limits x = round_limits(limits_of(fitted));
  const Limits y = limits_of(residual);
  constexpr double room = 1.15;
  const double reach = room * std::max(std::abs(y.lower), std::abs(y.upper));
  Chart chart;
  chart.curves = {guide("", x, 0.0, ink, LineKind::solid), dots(fitted, residual)};
  chart.style = {.x_name = "fitted value",
                 .x_unit = style.unit,
                 .y_name = "residual",
                 .y_unit = style.unit,
                 .x_limits = x,
                 .y_limits = reach > 0.0 ? Limits{-reach, reach} : Limits{-1.0, 1.0},
                 .notes = style.notes,
                 .title = style.quantity};
  return chart;
}

} // namespace scarp::render
