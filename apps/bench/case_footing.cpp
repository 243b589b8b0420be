// Bearing capacity of a strip footing (apps/bench/footing.hpp) against Prandtl.
//
// The error that is left is of first order: nodes under the footing's edge hold the soil beside it
// as well, so the footing acts about a cell wider than it is, more with wider shape functions.
#include "apps/bench/cases.hpp"
#include "apps/bench/charts.hpp"
#include "apps/bench/footing.hpp"

#include <fmt/format.h>

#include <cmath>

namespace scarp::bench {

namespace {

struct Way {
  std::string name;
  ShapeFunctions shape;
  VolumeRate rate;
};

struct Refinement {
  Convergence error;
  std::vector<FootingRun> runs;
};

Refinement refine(const Way& way, const std::vector<int>& levels) {
  Discretisation how;
  how.method.shape = way.shape;
  how.method.volume_rate = way.rate;
  how.method.flip = 0.99; // takes the elastic swing; the momentum of the footing is kept
  Refinement refinement = {{way.name, {}, {}}, {}};
  for (const int cells : levels) {
    refinement.runs.push_back(press_footing(cells, how));
    refinement.error.cell_size.push_back(1.0 / cells);
    refinement.error.error.push_back(std::abs(refinement.runs.back().limit() / prandtl - 1.0));
  }
  return refinement;
}

/// Pressure over settlement, a curve a run.
render::Chart loads(const Refinement& free, const Refinement& locked,
                    const std::vector<int>& levels) {
  render::Chart chart;
  chart.style = {.x_name = "settlement / B",
                 .y_name = "load / (c B)",
                 .y_limits = render::Limits{0.0, 1.5 * prandtl},
                 .title = "Load"};
  const auto add = [&](const Refinement& refinement, render::LineKind line) {
    for (std::size_t i = 0; i < refinement.runs.size(); ++i)
      chart.curves.push_back(
          {.label = fmt::format("{}, {} cells", refinement.error.name, levels[i]),
           .x = refinement.runs[i].settlement,
           .y = refinement.runs[i].pressure,
           .line = line});
  };
  add(free, render::LineKind::solid);
  add(locked, render::LineKind::dashed);
  chart.curves.push_back({.label = "Prandtl, 2 + π",
                          .x = {0.0, free.runs.front().settlement.back()},
                          .y = {prandtl, prandtl},
                          .colour = render::ink,
                          .line = render::LineKind::dotted});
  return chart;
}

} // namespace

CaseReport footing_case(Effort effort) {
  const std::vector<int> levels = {8, 16, 32};
  const std::vector<int> coarse = effort == Effort::quick ? std::vector{8, 16} : levels;
  const Refinement averages =
      refine({"linear, cell averages", ShapeFunctions::linear, VolumeRate::cell_average}, levels);
  const Refinement locked = refine({"linear", ShapeFunctions::linear, VolumeRate::point}, coarse);
  const Refinement spline = refine(
      {"B-spline, cell averages", ShapeFunctions::bspline, VolumeRate::cell_average}, coarse);

  CaseReport report;
  const std::string source = "Prandtl 1920, rigid strip on phi = 0: (2 + pi) c B";
  report.checks = {
      {"load_32_cells", averages.runs.back().limit(), prandtl, 0.05, Bound::relative, "c B", source,
       "linear, cell averages, plane-strain cone (k = c), E/c = 4000"},
      {"order", averages.error.order(), 1.0, 0.5, Bound::at_least, "-",
       "first order: the footing acts about a cell too wide", "8, 16, 32 cells under the footing"},
      {"growth_32_cells", averages.runs.back().growth(), 0.0, 0.02, Bound::absolute, "-",
       "a limit load does not grow",
       "pressure of the last fifth of the settlement over that of the fifth before"},
      {"locking_16_cells",
       (locked.runs[1].limit() - prandtl) / (averages.runs[1].limit() - prandtl), 1.0, 1.0,
       Bound::at_least, "-", "rates of volume by point over-constrain linear functions",
       "error with rates by point over that with cell averages"}};
  report.convergence = {averages.error, locked.error, spline.error};
  report.figure = {
      loads(averages, locked, levels),
      convergence_chart(report.convergence, {1.0}, "cell size / B", "error of the load", "Error")};
  report.caption = "Strip footing: load over settlement, and the error of the limit load.";
  return report;
}

} // namespace scarp::bench
