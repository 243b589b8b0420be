#include "apps/bench/work.hpp"

#include "apps/bench/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace scarp::bench {

namespace {

using Work = double (*)(const WorkRun&);

/// Not where an error may be smaller or larger.
bool known(const WorkRun& run) {
  return run.failure.empty() && std::isfinite(run.outcome.error) &&
         !(run.converged && run.converged->upper > run.converged->lower);
}

/// Those that no other beats in both work and error.
render::Curve pareto_front(const std::vector<WorkRun>& runs, Work work) {
  std::vector<std::array<double, 2>> best;
  for (const WorkRun& run : runs) {
    if (!known(run)) continue;
    const bool beaten = std::ranges::any_of(runs, [&](const WorkRun& other) {
      const double error = other.outcome.error, own = run.outcome.error;
      const bool no_worse = error <= own && work(other) <= work(run);
      return known(other) && no_worse && (error < own || work(other) < work(run));
    });
    if (!beaten) best.push_back({work(run), run.outcome.error});
  }
  std::ranges::sort(best);
  render::Curve curve = {.label = "Pareto front",
                         .x = {},
                         .y = {},
                         .colour = render::ink,
                         .line = render::LineKind::dotted,
                         .marker = render::Marker::open_circle,
                         .weight = 1.8};
  for (const auto& [x, y] : best) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  return curve;
}

/// Of all methods of all charts, each once.
std::vector<std::string> every_name() {
  std::vector<std::string> names;
  for (const auto& plans :
       {every_method(Effort::full, {}), landslide_methods(Effort::full, {}, std::nullopt)})
    for (const WorkPlan& plan : plans)
      if (std::ranges::find(names, plan.method) == names.end()) names.push_back(plan.method);
  return names;
}

/// The same for a method in every chart.
render::Curve curve_of(const std::string& method) {
  using enum render::Marker;
  constexpr std::array markers = {circle, square, diamond};
  constexpr std::array lines = {render::LineKind::solid, render::LineKind::dashed,
                                render::LineKind::dotted};
  constexpr std::array colours = {render::palette::blue,   render::palette::vermilion,
                                  render::palette::green,  render::palette::purple,
                                  render::palette::orange, render::palette::sky};
  static const std::vector<std::string> all = every_name();
  const auto k = static_cast<std::size_t>(std::ranges::find(all, method) - all.begin());
  render::Curve curve;
  curve.label = method;
  curve.colour = colours[k % colours.size()];
  // Each round of lines has other markers than the one before, so that no two curves look alike.
  const std::size_t round = k / colours.size();
  curve.line = lines[round % lines.size()];
  curve.marker = markers[(round + round / lines.size()) % markers.size()];
  curve.weight = 0.9;
  return curve;
}

/// The methods' names in the order of their runs.
std::vector<std::string> methods_of(const WorkResult& result) {
  std::vector<std::string> names;
  for (const WorkRun& run : result.runs)
    if (names.empty() || names.back() != run.method) names.push_back(run.method);
  return names;
}

/// Vertical lines at each x from lower to upper.
render::Curve bars(const render::Curve& of, const std::vector<double>& lower,
                   const std::vector<double>& upper) {
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  render::Curve curve = {.label = "", .x = {}, .y = {}, .colour = of.colour, .weight = 0.5};
  for (std::size_t i = 0; i < lower.size(); ++i) {
    curve.x.insert(curve.x.end(), {of.x[i], of.x[i], gap});
    curve.y.insert(curve.y.end(), {lower[i], upper[i], gap});
  }
  return curve;
}

/// Of the errors, with room for bars.
render::Limits error_limits(const std::vector<WorkRun>& runs) {
  constexpr double room = 1.5;
  render::Limits limits = {1e300, 0.0};
  for (const WorkRun& run : runs)
    if (run.failure.empty() && run.outcome.error > 0.0)
      limits = {std::min(limits.lower, run.outcome.error / room),
                std::max(limits.upper, run.outcome.error * room)};
  return limits;
}

/// Its style has the name of the x axis.
render::Chart work_chart(const WorkResult& result, Work work, bool with_bars,
                         const render::ChartStyle& style) {
  render::Chart chart = {{}, style};
  chart.style.y_name = result.error();
  chart.style.y_limits = error_limits(result.runs);
  for (const std::string& method : methods_of(result)) {
    render::Curve curve = curve_of(method);
    std::vector<double> lower, upper;
    for (const WorkRun& run : result.runs) {
      if (run.method != method || !run.failure.empty() || std::isnan(run.outcome.error)) continue;
      curve.x.push_back(work(run));
      curve.y.push_back(run.outcome.error);
      const ConvergedError between = run.converged.value_or(ConvergedError{});
      lower.push_back(std::max(between.lower, chart.style.y_limits->lower));
      upper.push_back(std::min(between.upper, chart.style.y_limits->upper));
    }
    if (with_bars) chart.curves.push_back(bars(curve, lower, upper));
    chart.curves.push_back(curve);
  }
  if (std::ranges::any_of(result.runs, known))
    chart.curves.push_back(pareto_front(result.runs, work));
  return log_log(std::move(chart));
}

/// What is extrapolated stands to the left of all cell sizes, side by side.
render::Chart answer_chart(const WorkResult& result) {
  render::Chart chart;
  chart.style = {.x_name = "cell size", .x_unit = "m", .y_name = result.origin->converged->answer};
  std::map<double, std::string> sizes;
  for (const WorkRun& run : result.runs)
    sizes[run.cell_size] = fmt::format("{:.4g}", run.cell_size);
  const double largest = sizes.rbegin()->first;
  const double apart = 0.03 * largest;
  double next = -apart;
  for (const auto& [method, converged] : result.verdicts) {
    render::Curve curve = curve_of(method);
    for (const WorkRun& run : result.runs)
      if (run.method == method && run.failure.empty()) {
        curve.x.push_back(run.cell_size);
        curve.y.push_back(run.outcome.answer.front());
      }
    if (converged.value) {
      render::Curve limit = {.label = "",
                             .x = {next},
                             .y = {*converged.value},
                             .colour = curve.colour,
                             .marker = render::Marker::open_circle};
      chart.curves.push_back(
          bars(limit, {*converged.value - converged.bar}, {*converged.value + converged.bar}));
      chart.curves.push_back(limit);
      next -= apart;
    }
    chart.curves.push_back(curve);
  }
  if (next < -apart) sizes[0.5 * next] = "extrapolated";
  chart.style.x_limits = {next, largest + apart};
  for (const auto& [at, name] : sizes) chart.style.x_ticks.push_back({at, name});
  return chart;
}

} // namespace

std::vector<render::Chart> work_figure(const WorkResult& result) {
  // Bars in one of the two: over point-steps those of different methods cover each other.
  return {work_chart(result, [](const WorkRun& run) { return run.wall; }, result.to_converged(),
                     {.x_name = "wall time", .x_unit = "s"}),
          work_chart(result, [](const WorkRun& run) { return run.point_steps(); }, false,
                     {.x_name = "points × steps"})};
}

std::vector<render::Chart> answer_figure(const WorkResult& result) {
  if (!result.to_converged() || result.origin->converged->answer.empty()) return {};
  return {answer_chart(result)};
}

} // namespace scarp::bench
