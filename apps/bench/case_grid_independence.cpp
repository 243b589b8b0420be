// How much the grid shows: the same body laid into it at other places and angles.
//
// Elastic: a free bar, nu = 0 in plane strain, swings along its axis with f = c / 2L whatever its
// direction.  Its edges cut the lattice of points as they come.
// Plastic: a free-standing granular column, moved sideways by parts of a cell.
// The bounds, spreads of 2 % and 5 % (largest less least, over the mean), were chosen beforehand.
#include "apps/bench/cases.hpp"
#include "apps/bench/prepared.hpp"

#include "core/run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scarp::bench {

namespace {

using Shift = std::array<double, 2>; // parts of a cell, x z

constexpr double length = 1.0, thickness = 0.25;                    // m, of the bar
constexpr double density = 1000.0, modulus = 1e5, amplitude = 1e-4; // c = 10 m/s
constexpr double frequency = 10.0 / (2.0 * length);

/// Of the free bar at an angle (degrees) to the grid, parts of c / 2L.
double bar_frequency(int cells, double degrees, Shift shift) {
  const double h = length / cells;
  const double half = std::ceil(0.7 * cells) * h;
  const double angle = degrees * std::numbers::pi / 180.0;
  const double c = std::cos(angle), s = std::sin(angle);
  Scene scene;
  scene.grid = plane_grid(h, {-half, -half}, {half, half});
  scene.materials = {{"bar", density, modulus, 0.0, LinearElastic{}}};
  scene.gravity = {0.0, 0.0, 0.0};
  scene.method.shape = ShapeFunctions::bspline;
  Region bar;
  bar.name = bar.material = "bar";
  for (const auto& [along, across] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const double x = 0.5 * along * length, y = 0.5 * across * thickness;
    bar.polygon.push_back({c * x - s * y + shift[0] * h, s * x + c * y + shift[1] * h});
  }
  scene.regions = {bar};
  std::vector<double> mode; // velocity along the axis at the start
  const auto simulation = begin_with(scene, [&](Snapshot& start) {
    for (std::size_t p = 0; p < start.gap.size(); ++p) {
      const double along = c * (start.position[3 * p] - shift[0] * h) +
                           s * (start.position[3 * p + 2] - shift[1] * h);
      mode.push_back(std::sin(std::numbers::pi * along / length));
      start.velocity[3 * p] = amplitude * mode[p] * c;
      start.velocity[3 * p + 2] = amplitude * mode[p] * s;
    }
  });
  const std::vector<double> m = masses(*simulation);
  constexpr int periods = 5;
  int zeros = 0;
  double before = 1.0, first = 0.0, last = 0.0;
  while (zeros <= periods && simulation->time() < 2.0 * (periods + 1) / frequency) {
    const double dt = simulation->step(1e9);
    const std::vector<double> v = simulation->field("velocity");
    double now = 0.0;
    for (std::size_t p = 0; p < m.size(); ++p)
      now += m[p] * mode[p] * (c * v[3 * p] + s * v[3 * p + 2]);
    if (before > 0.0 && now <= 0.0 && simulation->steps() > 1) {
      last = simulation->time() - dt * now / (now - before);
      if (zeros++ == 0) first = last;
    }
    before = now;
  }
  return periods / (last - first) / frequency;
}

/// Half the width within which 99 % of a column, 0.2 m wide and 0.1 m high, come to rest.
double spread_width(int cells, double shift) {
  const double h = 0.1 / cells;
  Scene scene;
  scene.grid = plane_grid(h, {-0.5, 0.0}, {0.5, 0.15});
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.materials = {grains()};
  scene.method.shape = ShapeFunctions::bspline;
  scene.method.flip = 0.999;
  scene.regions = {box("column", "grains", {-0.1 + shift * h, 0.0}, {0.1 + shift * h, 0.1})};
  const auto simulation = make_simulation(scene);
  constexpr double end = 0.8; // s, eight times sqrt(H/g)
  run_until(*simulation, end);
  const std::vector<double> positions = simulation->positions();
  const std::vector<double> m = masses(*simulation);
  std::vector<std::pair<double, double>> from_centre;
  double all = 0.0;
  for (std::size_t p = 0; p < m.size(); ++p) {
    from_centre.emplace_back(std::abs(positions[3 * p] - shift * h), m[p]);
    all += m[p];
  }
  std::ranges::sort(from_centre);
  double inside = 0.0;
  for (const auto& [distance, mass] : from_centre)
    if ((inside += mass) >= 0.99 * all) return distance;
  return from_centre.back().first;
}

double spread(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  const auto [least, most] = std::ranges::minmax(values);
  return (most - least) / (sum / static_cast<double>(values.size()));
}

} // namespace

CaseReport grid_independence_case(Effort effort) {
  const int cells = 32;
  const std::vector<double> degrees =
      effort == Effort::quick
          ? std::vector{0.0, 10.0, 20.0, 30.0, 45.0}
          : std::vector{0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0};
  const std::vector<double> shifts = {0.0, 0.125, 0.25, 0.375, 0.5, 0.75};
  std::vector<double> by_angle, by_shift, columns;
  for (const double angle : degrees) by_angle.push_back(bar_frequency(cells, angle, {0.0, 0.0}));
  for (const double shift : shifts)
    by_shift.push_back(bar_frequency(cells, 0.0, {shift, 0.4 * shift}));
  for (const double shift : shifts) columns.push_back(spread_width(10, shift));

  CaseReport report;
  const std::string source = "neither the grid's place nor its direction is part of the problem";
  report.checks = {{"bar_frequency_by_angle", spread(by_angle), 0.0, 0.02, Bound::at_most, "-",
                    source, "largest less least over the mean; free bar, 32 cells long, 0 to 45°"},
                   {"bar_frequency_by_offset", spread(by_shift), 0.0, 0.02, Bound::at_most, "-",
                    source, "offsets by parts of a cell in x and z"},
                   {"column_width_by_offset", spread(columns), 0.0, 0.05, Bound::at_most, "-",
                    source, "granular column, offsets by parts of a cell along its base"}};
  const auto per_cent = [](std::vector<double> values) {
    for (double& value : values) value = 100.0 * (value - 1.0);
    return values;
  };
  const auto dots = [](const std::vector<double>& x, std::vector<double> y) {
    return render::Curve{.x = x, .y = std::move(y), .marker = render::Marker::circle};
  };
  report.figure = {{{dots(degrees, per_cent(by_angle))},
                    {.x_name = "angle to the grid",
                     .x_unit = "°",
                     .y_name = "error of the frequency",
                     .y_unit = "%",
                     .title = "Bar, turned"}},
                   {{dots(shifts, per_cent(by_shift))},
                    {.x_name = "offset / cell",
                     .y_name = "error of the frequency",
                     .y_unit = "%",
                     .title = "Bar, moved"}},
                   {{dots(shifts, columns)},
                    {.x_name = "offset / cell",
                     .y_name = "half-width of 99 %",
                     .y_unit = "m",
                     .title = "Granular column, moved"}}};
  report.caption = "The same body at other places and angles in the grid.";
  return report;
}

} // namespace scarp::bench
