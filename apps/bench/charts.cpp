#include "apps/bench/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::bench {

namespace {

std::string power_of_ten(int power) {
  static const std::vector<std::string> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = power < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(power)))
    text += digits.at(static_cast<std::size_t>(digit - '0'));
  return text;
}

/// 0.05, 20 or 2·10⁻⁵
std::string tick_name(int factor, int power) {
  constexpr int plain = 3;
  if (std::abs(power) <= plain) return fmt::format("{:g}", factor * std::pow(10.0, power));
  return (factor == 1 ? "" : fmt::format("{}·", factor)) + power_of_ten(power);
}

/// Those within the limits, which are logarithms.
std::vector<render::Tick> log_ticks(const render::Limits& limits) {
  constexpr double few_decades = 2.2;
  constexpr double many_decades = 9.0;
  const double decades = limits.upper - limits.lower;
  const int stride = decades > many_decades ? 2 : 1;
  std::vector<render::Tick> ticks;
  for (int power = static_cast<int>(std::floor(limits.lower)); power <= limits.upper;
       power += stride)
    for (const int factor : {1, 2, 5}) {
      const double at = power + std::log10(factor);
      if (factor > 1 && decades > few_decades) continue;
      if (at >= limits.lower && at <= limits.upper) ticks.push_back({at, tick_name(factor, power)});
    }
  return ticks;
}

void take_log(std::vector<double>& values) {
  for (double& value : values)
    value = value > 0.0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
}

render::Limits limits_of(const std::vector<render::Curve>& curves,
                         std::vector<double> render::Curve::*member) {
  constexpr double room = 0.08; // decades
  render::Limits limits = {1e300, -1e300};
  for (const render::Curve& curve : curves)
    for (const double value : curve.*member)
      if (std::isfinite(value))
        limits = {std::min(limits.lower, value), std::max(limits.upper, value)};
  return {limits.lower - room, limits.upper + room};
}

} // namespace

render::Chart log_log(render::Chart chart) {
  for (render::Curve& curve : chart.curves) {
    take_log(curve.x);
    take_log(curve.y);
  }
  const auto limits = [](std::optional<render::Limits> given, render::Limits found) {
    return given ? render::Limits{std::log10(given->lower), std::log10(given->upper)} : found;
  };
  render::ChartStyle& style = chart.style;
  style.x_limits = limits(style.x_limits, limits_of(chart.curves, &render::Curve::x));
  style.y_limits = limits(style.y_limits, limits_of(chart.curves, &render::Curve::y));
  style.x_ticks = log_ticks(*style.x_limits);
  style.y_ticks = log_ticks(*style.y_limits);
  return chart;
}

render::Chart convergence_chart(const std::vector<Convergence>& measured,
                                const std::vector<double>& orders, const std::string& x_name,
                                const std::string& y_name, const std::string& title) {
  render::Chart chart;
  chart.style = {.x_name = x_name, .y_name = y_name, .title = title};
  for (const Convergence& one : measured)
    chart.curves.push_back({.label = fmt::format("{} (order {:.2f})", one.name, one.order()),
                            .x = one.cell_size,
                            .y = one.error,
                            .marker = render::Marker::circle});
  if (!measured.empty()) {
    const std::vector<double>& h = measured.front().cell_size;
    const double coarsest = *std::ranges::max_element(h);
    const double finest = *std::ranges::min_element(h);
    const double least = measured.front().error.at(
        static_cast<std::size_t>(std::ranges::min_element(h) - h.begin()));
    for (const double order : orders)
      chart.curves.push_back({.label = fmt::format("slope {:g}", order),
                              .x = {finest, coarsest},
                              .y = {least, least * std::pow(coarsest / finest, order)},
                              .colour = render::palette::grey,
                              .line = render::LineKind::dashed,
                              .weight = 0.7});
  }
  return log_log(std::move(chart));
}

} // namespace scarp::bench
