// Factor of safety of a homogeneous slope by strength reduction (apps/safety.hpp): example 1 of
// Griffiths & Lane 1999, 1.4; Bishop & Morgenstern 1960, 1.38.
#include "apps/bench/cases.hpp"

#include "apps/safety.hpp"
#include "apps/safety_search.hpp"
#include "core/error.hpp"

#include <cmath>
#include <numeric>

namespace scarp::bench {

namespace {

/// H = 10 m, face 2:1, c / (gamma H) = 0.05, phi = 20 degrees; see
/// data/scenes/griffiths_lane_1999.toml.
Scene slope(int cells_a_height) {
  const double h = 10.0 / cells_a_height;
  Scene scene;
  scene.grid.cell_size = h;
  scene.grid.upper = {36.0, 0.0, 12.0};
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.gravity = {0.0, 0.0, -10.0};
  DruckerPrager law;
  law.cohesion = 10e3;
  law.friction_angle = 20.0;
  law.cone = Cone::plane_strain;
  scene.materials = {{"soil", 2000.0, 1e8, 0.3, law}};
  scene.method.shape = ShapeFunctions::bspline;
  scene.method.local_damping = apps::StrengthReduction::usual_damping;
  Region region;
  region.name = "slope";
  region.material = "soil";
  region.polygon = {{0.0, 0.0}, {32.0, 0.0}, {12.0, 10.0}, {0.0, 10.0}};
  scene.regions = {region};
  return scene;
}

} // namespace

CaseReport safety_case(Effort effort) {
  const bool quick = effort == Effort::quick;
  const int cells = quick ? 10 : 20;
  apps::StrengthReduction body(slope(cells));
  body.settle();
  render::Curve stable = {.label = "stands",
                          .x = {},
                          .y = {},
                          .line = render::LineKind::none,
                          .marker = render::Marker::circle};
  render::Curve failed = stable;
  failed.label = "fails";
  failed.marker = render::Marker::square;
  const apps::SearchOptions search = {.lower = 1.2, .upper = 1.7, .tolerance = quick ? 0.04 : 0.01};
  const apps::Bracket bracket = apps::find_bracket(search, [&](double factor) {
    const apps::Trial trial = body.try_factor(factor, [](double, double) {});
    render::Curve& curve = trial.fails() ? failed : stable;
    curve.x.push_back(factor);
    curve.y.push_back(1e3 * trial.displacement);
    return trial.fails();
  });
  const double factor =
      std::midpoint(bracket.stable.value_or(search.lower), bracket.failed.value_or(search.upper));
  CaseReport report;
  report.checks = {{"factor", factor, 1.40, 0.05, Bound::absolute, "-",
                    "Griffiths & Lane 1999, example 1: 1.4; Bishop & Morgenstern 1960: 1.38",
                    quick ? "B-splines, cells of H/10" : "B-splines, cells of H/20"}};
  report.figure = {{{stable, failed},
                    {.x_name = "factor that divides the strength",
                     .y_name = "largest displacement",
                     .y_unit = "mm"}}};
  report.caption =
      "Strength reduction: displacement of each trial, up to where it counts as failed.";
  return report;
}

} // namespace scarp::bench
