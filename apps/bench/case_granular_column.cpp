// Collapse of a granular column against experiments in a channel: how far it runs, by its aspect
// ratio a = H_0 / L_0 (L_0 from the wall to the face).
//
//   |####|                 run-out (L_end - L_0) / L_0
//   |####|  H_0            Lube et al. 2005:        1.2 a (a < 1.8), 1.9 a^(2/3) (a > 2.8)
//   |####|___________      Lajeunesse et al. 2005:  about a (a < 3), about a^(2/3) beyond
//    L_0
//
// Lube G., Huppert H. E., Sparks R. S. J. & Freundt A. 2005, Phys. Rev. E 72:041301, doi
// 10.1103/PhysRevE.72.041301; Lajeunesse E., Monnier J. B. & Homsy G. M. 2005, Phys. Fluids
// 17:103302, doi 10.1063/1.2087687.  Their grains (sand, glass, ...) have angles of repose of about
// 30 degrees; here 30 degrees without cohesion or dilation, plane-strain cone, on a rough base.
//
// The bounds, +- 25 % of the slope and of the exponent, were chosen before any run.  The front is
// the farthest x behind which 99.5 % of the mass lie: single grains that run ahead are not counted
// in the experiments either.
#include "apps/bench/cases.hpp"
#include "apps/bench/charts.hpp"
#include "apps/bench/prepared.hpp"

#include "core/run.hpp"

#include <algorithm>
#include <cmath>

namespace scarp::bench {

namespace {

constexpr double length = 0.1; // m, L_0
constexpr double g = 9.81;     // m/s2

Scene column(double aspect, int cells) {
  const double h = length / cells;
  const auto planes = [h](double x) { return std::ceil(x / h - 1e-9) * h; };
  const double height = aspect * length;
  Scene scene;
  scene.grid = plane_grid(h, {0.0, 0.0},
                          {planes(length * (2.5 + 2.5 * aspect)), planes(1.1 * height) + 2.0 * h});
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.materials = {grains()};
  scene.gravity = {0.0, 0.0, -g};
  scene.method.shape = ShapeFunctions::bspline;
  scene.method.flip = 0.999;
  scene.regions = {box("column", "grains", {0.0, 0.0}, {length, height})};
  // The spreading takes some 3.3 sqrt(H_0/g) (Lube); rest ends it earlier.
  scene.timing.end_time = 8.0 * std::sqrt(height / g);
  scene.timing.output_interval = scene.timing.end_time;
  scene.timing.rest_energy_fraction = 1e-3;
  scene.timing.rest_duration = 0.1;
  return scene;
}

double run_out(double aspect, int cells) {
  const Scene scene = column(aspect, cells);
  const auto simulation = make_simulation(scene);
  Observer nobody;
  run(*simulation, scene.timing, nobody);
  const std::vector<double> positions = simulation->positions();
  std::vector<double> x;
  for (std::size_t p = 0; p < simulation->points(); ++p) x.push_back(positions[3 * p]);
  const auto front = static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(x.size()));
  std::ranges::nth_element(x, x.begin() + front);
  return x[static_cast<std::size_t>(front)] / length - 1.0;
}

/// Exponent of y ~ x^n by least squares of the logarithms.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  return Convergence{"", x, y}.order();
}

} // namespace

CaseReport granular_column_case(Effort effort) {
  const int cells = effort == Effort::quick ? 10 : 20;
  const std::vector<double> low =
      effort == Effort::quick ? std::vector{0.5, 1.0, 1.5} : std::vector{0.5, 0.8, 1.1, 1.4, 1.7};
  const std::vector<double> high =
      effort == Effort::quick ? std::vector{3.0, 5.0, 8.0} : std::vector{3.0, 4.0, 6.0, 8.0, 10.0};
  std::vector<double> of_low, of_high;
  double xy = 0.0, xx = 0.0;
  for (const double aspect : low) {
    of_low.push_back(run_out(aspect, cells));
    xy += aspect * of_low.back();
    xx += aspect * aspect;
  }
  for (const double aspect : high) of_high.push_back(run_out(aspect, cells));

  CaseReport report;
  const std::string lube = "Lube et al. 2005, Phys. Rev. E 72:041301";
  const std::string reason = "The friction angle decides: 35° instead of the angle of repose gives "
                             "1.28 at a = 1 and 2.16 a^(2/3) at a = 5";
  constexpr double tolerance = 0.25;
  report.checks = {
      {"slope_low_columns", xy / xx, 1.2, tolerance, Bound::relative, "-", lube,
       "run-out over aspect ratio, a < 1.8; bound chosen beforehand. " + reason},
      {"exponent_high_columns", exponent(high, of_high), 2.0 / 3.0, tolerance, Bound::relative, "-",
       lube + "; Lajeunesse et al. 2005", "a > 2.8; bound chosen beforehand"},
      {"run_out_at_5",
       of_high[static_cast<std::size_t>(
           std::ranges::min_element(high, {}, [](double a) { return std::abs(a - 5.0); }) -
           high.begin())] /
           std::pow(*std::ranges::min_element(high, {}, [](double a) { return std::abs(a - 5.0); }),
                    2.0 / 3.0),
       1.9, tolerance, Bound::relative, "-", lube,
       "run-out over a^(2/3) at the aspect ratio next to 5. " + reason}};
  render::Curve measured = {.label = "scarp",
                            .x = low,
                            .y = of_low,
                            .line = render::LineKind::none,
                            .marker = render::Marker::circle};
  measured.x.insert(measured.x.end(), high.begin(), high.end());
  measured.y.insert(measured.y.end(), of_high.begin(), of_high.end());
  const auto power = [](double a, double factor, double n) { return factor * std::pow(a, n); };
  render::Chart chart;
  chart.curves = {{.label = "Lube et al. 2005",
                   .x = {0.5, 1.8},
                   .y = {0.6, 2.16},
                   .colour = render::palette::vermilion},
                  {.label = "",
                   .x = {2.8, 10.0},
                   .y = {power(2.8, 1.9, 2.0 / 3.0), power(10.0, 1.9, 2.0 / 3.0)},
                   .colour = render::palette::vermilion},
                  {.label = "Lajeunesse et al. 2005, a and a^(2/3)",
                   .x = {0.5, 3.0, 10.0},
                   .y = {0.5, 3.0, 3.0 * std::pow(10.0 / 3.0, 2.0 / 3.0)},
                   .colour = render::palette::grey,
                   .line = render::LineKind::dashed},
                  measured};
  chart.style = {.x_name = "aspect ratio a", .y_name = "run-out / initial length"};
  report.figure = {log_log(std::move(chart))};
  report.caption = "Collapse of granular columns: run-out over aspect ratio.";
  return report;
}

} // namespace scarp::bench
