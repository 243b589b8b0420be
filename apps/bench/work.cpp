#include "apps/bench/work.hpp"

#include "apps/bench/charts.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

namespace scarp::bench {

namespace {

struct NamedMethod {
  std::string name;
  Discretisation how;
};

/// Shape functions, transfer and rate of volume with their usual points and CFL, then one change of
/// these at a time for two of them.  Affine transfers are not defined with linear functions and
/// FLIP; APIC takes USL, as README.md does.
std::vector<NamedMethod> methods(Effort effort) {
  using enum ShapeFunctions;
  using enum VelocityTransfer;
  const auto method = [](ShapeFunctions shape, VelocityTransfer transfer = flip,
                         VolumeRate rate = VolumeRate::point) {
    Discretisation how;
    how.method.shape = shape;
    how.method.transfer = transfer;
    how.method.volume_rate = rate;
    if (transfer == apic) how.method.scheme = Scheme::usl;
    return how;
  };
  std::vector<NamedMethod> all = {
      {"linear", method(linear)},
      {"linear, cell averages", method(linear, flip, VolumeRate::cell_average)},
      {"GIMP", method(gimp)},
      {"B-spline", method(bspline)},
      {"B-spline, cell averages", method(bspline, flip, VolumeRate::cell_average)},
      {"B-spline, APIC", method(bspline, apic)}};
  all.push_back({"linear, single precision", method(linear)});
  all.back().how.method.precision = Precision::single;
  if (effort == Effort::quick) return all;
  all.push_back({"B-spline, single precision", method(bspline)});
  all.back().how.method.precision = Precision::single;
  all.push_back({"B-spline, APIC, single precision", method(bspline, apic)});
  all.back().how.method.precision = Precision::single;
  all.push_back({"GIMP, APIC", method(gimp, apic)});
  all.push_back({"B-spline, AFLIP", method(bspline, aflip)});
  for (const int points : {3, 4}) {
    all.push_back({fmt::format("linear, {}² points", points), method(linear)});
    all.back().how.points_per_cell = points;
    all.push_back({fmt::format("B-spline, {}² points", points), method(bspline)});
    all.back().how.points_per_cell = points;
  }
  for (const double cfl : {0.1, 0.6}) {
    all.push_back({fmt::format("B-spline, CFL {}", cfl), method(bspline)});
    all.back().how.cfl = cfl;
  }
  return all;
}

WorkRun run_one(const WorkScene& scene, int cells, const NamedMethod& method) {
  WorkRun run = {scene.name, method.name, method.how, scene.cell_size(cells), {}, {}, 0.0};
  const auto start = std::chrono::steady_clock::now();
  try {
    run.outcome = scene.run(cells, method.how);
  } catch (const RunError& error) {
    run.failure = error.what();
  }
  run.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

using Work = double (*)(const WorkRun&);

/// Those that no other beats in both work and error.
render::Curve pareto_front(const std::vector<WorkRun>& runs, Work work) {
  std::vector<std::array<double, 2>> best;
  for (const WorkRun& run : runs) {
    const bool beaten = std::ranges::any_of(runs, [&](const WorkRun& other) {
      const double error = other.outcome.error, own = run.outcome.error;
      const bool no_worse = error <= own && work(other) <= work(run);
      return other.failure.empty() && no_worse && (error < own || work(other) < work(run));
    });
    if (run.failure.empty() && !beaten) best.push_back({work(run), run.outcome.error});
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

render::Chart work_chart(const WorkResult& result, Work work, const std::string& name,
                         const std::string& unit) {
  using enum render::Marker;
  constexpr std::array markers = {circle, square, diamond};
  constexpr std::array lines = {render::LineKind::solid, render::LineKind::dashed,
                                render::LineKind::dotted};
  constexpr std::array colours = {render::palette::blue,   render::palette::vermilion,
                                  render::palette::green,  render::palette::purple,
                                  render::palette::orange, render::palette::sky};
  std::vector<std::string> order;
  std::map<std::string, render::Curve> curves;
  for (const WorkRun& run : result.runs) {
    if (!run.failure.empty()) continue;
    const bool first = !curves.contains(run.method);
    render::Curve& curve = curves[run.method];
    if (first) {
      const std::size_t k = order.size();
      curve.label = run.method;
      curve.colour = colours[k % colours.size()];
      curve.line = lines[k / colours.size() % lines.size()];
      curve.marker = markers[k / colours.size() % markers.size()];
      curve.weight = 0.9;
      order.push_back(run.method);
    }
    curve.x.push_back(work(run));
    curve.y.push_back(run.outcome.error);
  }
  render::Chart chart;
  chart.style = {.x_name = name, .x_unit = unit, .y_name = result.origin->error};
  for (const std::string& method : order) chart.curves.push_back(curves[method]);
  chart.curves.push_back(pareto_front(result.runs, work));
  return log_log(std::move(chart));
}

} // namespace

WorkResult run_work(const WorkScene& scene, Effort effort,
                    const std::function<void(const WorkRun&)>& done) {
  WorkResult result;
  result.origin = &scene;
  for (const NamedMethod& method : methods(effort))
    for (const int cells : scene.levels(effort)) {
      result.runs.push_back(run_one(scene, cells, method));
      done(result.runs.back());
    }
  return result;
}

std::vector<render::Chart> work_figure(const WorkResult& result) {
  return {work_chart(
              result, [](const WorkRun& run) { return run.wall; }, "wall time", "s"),
          work_chart(
              result, [](const WorkRun& run) { return run.point_steps(); }, "points × steps", "")};
}

nlohmann::ordered_json to_json(const WorkRun& run) {
  nlohmann::ordered_json record = {
      {"scene", run.scene},           {"method", run.method},
      {"cell_size", run.cell_size},   {"points_per_cell", run.how.points_per_cell},
      {"cfl", run.how.cfl},           {"error", run.outcome.error},
      {"wall_s", run.wall},           {"point_steps", run.point_steps()},
      {"points", run.outcome.points}, {"steps", run.outcome.steps}};
  if (!run.failure.empty()) {
    record["error"] = nullptr;
    record["failure"] = run.failure;
  }
  return record;
}

} // namespace scarp::bench
