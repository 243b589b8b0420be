#include "render/validation_figure.hpp"

#include "render/body.hpp"
#include "render/contour.hpp"
#include "render/undeformed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::render {

namespace {

/// 12 800
std::string grouped(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text.push_back(' ');
    text.push_back(digits[i]);
  }
  return text;
}

std::string error_text(const CurveError& error) {
  constexpr double laboratory = 0.1; // m; larger errors read better in metres
  if (error.max < laboratory)
    return fmt::format("RMS {:.1f} mm, largest {:.1f} mm", 1e3 * error.rms, 1e3 * error.max);
  return fmt::format("RMS {:.2f} m, largest {:.2f} m", error.rms, error.max);
}

/// The free surface every half cell; it comes down to the ground at the run-out.
Curve surface_curve(const BodyShape& body) {
  Curve curve;
  const NodeField& fraction = body.fraction;
  const double step = 0.5 * fraction.cell_size;
  double x = fraction.lower.x;
  for (std::size_t i = 0; x < body.run_out;
       x = fraction.lower.x + step * static_cast<double>(++i)) {
    curve.x.push_back(x);
    curve.y.push_back(body.height_at(x).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (body.run_out > fraction.lower.x && body.run_out < fraction.upper().x) {
    curve.x.push_back(body.run_out);
    curve.y.push_back(fraction.lower.y);
  }
  return curve;
}

Curve experiment_curve(const io::Table& table, const std::string& label, Marker marker) {
  Curve curve = {label, table.column("x_m"), table.column("z_m")};
  curve.colour = ink;
  curve.line = LineKind::none;
  curve.marker = marker;
  return curve;
}

Curve outline_curve(const io::Frame& frame) {
  Curve curve;
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  for (const Polyline& line : contour_lines(volume_fraction(undeformed(frame)), body_level)) {
    for (const Point point : line) {
      curve.x.push_back(point.x);
      curve.y.push_back(point.y);
    }
    curve.x.push_back(gap);
    curve.y.push_back(gap);
  }
  curve.label = "before release";
  curve.colour = palette::grey;
  curve.line = LineKind::dashed;
  return curve;
}

} // namespace

std::vector<Curve> validation_curves(const io::Frame& frame, const ValidationStyle& style) {
  const bool moved = frame.has("displacement");
  const BodyShape body = measure_body(frame);
  std::vector<Curve> curves;
  if (moved) curves.push_back(outline_curve(frame));

  Curve surface = surface_curve(body);
  surface.label =
      fmt::format("free surface, {}, {} points", style.model_name, grouped(frame.size()));
  if (style.surface)
    surface.label += fmt::format(": {}", error_text(surface_error(body, *style.surface)));
  surface.colour = palette::blue;
  curves.push_back(std::move(surface));
  if (moved) {
    const FailureLine line = failure_line(frame);
    Curve failure = {fmt::format("failure line, {}", style.model_name), line.x, line.z};
    if (style.failure)
      failure.label += fmt::format(": {}", error_text(failure_error(line, *style.failure)));
    failure.colour = palette::vermilion;
    curves.push_back(std::move(failure));
  }
  if (style.surface)
    curves.push_back(experiment_curve(
        *style.surface, fmt::format("free surface, {}", style.experiment_name), Marker::circle));
  if (style.failure)
    curves.push_back(experiment_curve(*style.failure,
                                      fmt::format("failure line, {}", style.experiment_name),
                                      Marker::open_circle));
  return curves;
}

Drawing draw_validation(const io::Frame& frame, const ValidationStyle& style) {
  const std::vector<Curve> curves = validation_curves(frame, style);
  Point upper = {frame.lower[0], frame.lower[2]};
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
      upper.x = std::max(upper.x, curve.x[i]);
      upper.y = std::max(upper.y, curve.y[i]);
    }
  }
  constexpr double air = 0.04;
  const ChartStyle chart = {
      .x_name = "x",
      .x_unit = "m",
      .y_name = "z",
      .y_unit = "m",
      .x_limits = Limits{frame.lower[0], upper.x + air * (upper.x - frame.lower[0])},
      .y_limits = Limits{frame.lower[2], upper.y + 3.0 * air * (upper.y - frame.lower[2])},
      .equal_scales = true,
      .title = style.title,
      .width = style.width,
      .height = style.height,
      .font_size = style.font_size};
  return draw_chart(curves, chart);
}

Image render_validation(const io::Frame& frame, const ValidationStyle& style) {
  return rasterize(draw_validation(frame, style));
}

} // namespace scarp::render
