#include "apps/wu2017_case.hpp"

#include "apps/study_results.hpp"
#include "io/series.hpp"
#include "render/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace scarp::apps {

const std::array<Quantity, 4>& quantities() {
  static const std::array<Quantity, 4> all = {{
      {"peak_velocity_m_s", "peak velocity of C", "v", "m/s", "peak_velocity_m_s",
       "peak_velocity_C_m_s", 2},
      {"peak_acceleration_m_s2", "peak acceleration of C", "a", "m/s\u00b2",
       "peak_acceleration_m_s2", "peak_acceleration_C_m_s2", 2},
      {"runout_m", "run-out", "L", "m", "runout_m", "runout_m", 1},
      {"peak_kinetic_energy_kJ", "peak kinetic energy", "E", "kJ", "peak_kinetic_energy_kJ",
       "peak_kinetic_energy_kJ", 0},
  }};
  return all;
}

const std::array<std::string, 3>& predictors() {
  static const std::array<std::string, 3> all = {"cohesion_kPa", "friction_angle_deg",
                                                 "surcharge_kPa"};
  return all;
}

namespace {

analysis::Signal part(const analysis::Signal& signal, double from, double to) {
  analysis::Signal cut;
  for (std::size_t i = 0; i < signal.time.size(); ++i)
    if (signal.time[i] >= from && signal.time[i] <= to) {
      cut.time.push_back(signal.time[i]);
      cut.value.push_back(signal.value[i]);
    }
  return cut;
}

FittedCurve fitted(const std::string& monitor, const std::string& what,
                   const analysis::Signal& velocity, double from, double to,
                   analysis::CurveFit (*fit)(const analysis::Signal&)) {
  FittedCurve curve{monitor, what, from, to, {}};
  try {
    curve.fit = fit(part(velocity, from, to));
  } catch (const std::exception&) { // too few samples, or a course that no such curve follows
    curve.fit.reset();
  }
  return curve;
}

/// A's two branches (eqs. 20, 21), the whole course of B and C (eqs. 22, 23).
std::vector<FittedCurve> fit_velocities(const BaseCase& base, double loading, double rest) {
  std::vector<FittedCurve> fits;
  const std::vector<double>& time = base.history.column("time_s");
  for (std::size_t m = 0; m < base.scene.monitors.size(); ++m) {
    const std::string& name = base.scene.monitors[m].name;
    const analysis::Signal velocity{time, base.history.column(name + "_vx_m_s")};
    const double peak = base.measures.monitors[m].velocity.time;
    if (m == 0) {
      fits.push_back(fitted(name, "rising branch, exponential", velocity, loading, peak,
                            analysis::fit_exponential));
      fits.push_back(fitted(name, "falling branch, exponential", velocity, peak, rest,
                            analysis::fit_exponential));
    } else {
      fits.push_back(fitted(name, "whole course, Gaussian", velocity, loading, time.back(),
                            analysis::fit_gaussian));
    }
  }
  return fits;
}

} // namespace

BaseCase read_base_case(const std::filesystem::path& folder, const Scene& scene,
                        const analysis::MeasureOptions& options) {
  BaseCase base;
  base.folder = folder;
  base.scene = scene;
  base.history = io::read_table(folder / "history.csv");
  const std::vector<double>& time = base.history.column("time_s");
  const analysis::SlideRecord record =
      slide_record(scene, [&](const std::string& name) { return base.history.column(name); });
  for (const std::vector<double>& velocity : record.monitor_velocity)
    base.velocity.push_back(analysis::smooth({time, velocity}, options.smoothing_width));
  base.measures = analysis::measure(record, options);
  const double rest = base.measures.rest.value_or(time.back());
  if (!base.velocity.empty())
    base.stages = analysis::find_stages(
        time, base.velocity.back(), options.loading_start,
        std::clamp(base.measures.kinetic_energy.time, options.loading_start, rest), rest);
  base.fits = fit_velocities(base, options.loading_start, rest);
  const io::SeriesReader series(folder);
  base.thrown = render::thrown_off(series.read(series.size() - 1)).size();
  return base;
}

Agreement agreement(const std::vector<double>& paper, const std::vector<double>& computed) {
  const auto n = static_cast<double>(paper.size());
  const auto mean = [n](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / n;
  };
  const double x_mean = mean(paper), y_mean = mean(computed);
  double xx = 0.0, yy = 0.0, xy = 0.0, error2 = 0.0, error = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < paper.size(); ++i) {
    const double x = paper[i] - x_mean, y = computed[i] - y_mean;
    xx += x * x;
    yy += y * y;
    xy += x * y;
    const double difference = std::abs(computed[i] - paper[i]);
    error += difference / n;
    error2 += difference * difference;
    largest = std::max(largest, difference);
  }
  return {xy * xy / (xx * yy), 1.0 - error2 / xx, error, largest};
}

Regressions regressions(const io::Table& table, std::string Quantity::*column) {
  std::vector<std::vector<double>> inputs;
  for (const std::string& name : predictors()) inputs.push_back(table.column(name));
  Regressions all;
  for (const Quantity& quantity : quantities())
    all.emplace(quantity.key, analysis::regress(inputs, table.column(quantity.*column)));
  return all;
}

std::string equation(const Quantity& quantity, const analysis::Regression& regression) {
  const auto& b = regression.coefficients;
  std::string text = fmt::format("{} = {:.4g}", quantity.symbol, b[0]);
  const std::array<const char*, 3> symbols = {"c", "\u03c6", "p"};
  for (std::size_t i = 0; i < symbols.size(); ++i)
    text +=
        fmt::format(" {} {:.4g} {}", b[i + 1] < 0.0 ? '-' : '+', std::abs(b[i + 1]), symbols[i]);
  return text;
}

} // namespace scarp::apps
