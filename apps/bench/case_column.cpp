// An elastic column between smooth sides comes to rest under its own weight:
//   s_zz = - rho g (H - z),   s_xx = nu/(1 - nu) s_zz,   settlement of the top rho g H^2 / 2M,
// of the column as it lies: small strains, so that height and density are those at the start.
#include "apps/bench/cases.hpp"
#include "apps/bench/charts.hpp"
#include "apps/bench/prepared.hpp"

#include <cmath>

namespace scarp::bench {

namespace {

constexpr double height = 2.0, density = 2000.0, g = 9.8; // m, kg/m3, m/s2
constexpr double nu = 0.25;
constexpr double modulus = 600e6; // Pa, of uniaxial strain: 1.2 E.  Strains of 7e-5
constexpr double base_pressure = density * g * height;

struct Column {
  std::vector<double> z;        ///< m
  std::vector<double> pressure; ///< Pa, -s_zz
  double stress_error = 0.0;    ///< -, rms over the points, parts of the base's
  double lateral = 0.0;         ///< -, s_xx / s_zz, all points together
  double settlement_error = 0.0;
};

Column settle(int cells) {
  const double h = height / cells;
  Scene scene;
  scene.grid = plane_grid(h, {0.0, 0.0}, {h, height + 2.0 * h});
  for (const auto& [axis, side] : {std::pair{0U, 0U}, {0U, 1U}, {2U, 0U}})
    scene.grid.walls[axis][side].kind = WallKind::symmetry;
  scene.materials = {{"soil", density, modulus / 1.2, nu, LinearElastic{}}};
  scene.gravity = {0.0, 0.0, -g};
  scene.method.local_damping = 0.2;
  scene.regions = {box("column", "soil", {0.0, 0.0}, {h, height})};
  const auto simulation = make_simulation(scene);
  constexpr double periods = 40.0;
  run_until(*simulation, periods * 4.0 * height / std::sqrt(modulus / density));

  const std::vector<double> x = simulation->positions();
  const std::vector<double> u = simulation->field("displacement");
  const std::vector<double> stress = simulation->field("stress");
  Column column;
  double error2 = 0.0, sum_x = 0.0, sum_z = 0.0, moved = 0.0, should = 0.0;
  for (std::size_t p = 0; p < simulation->points(); ++p) {
    const double z = x[3 * p + 2] - u[3 * p + 2];
    column.z.push_back(z);
    column.pressure.push_back(-stress[6 * p + 2]);
    error2 += std::pow(-stress[6 * p + 2] - density * g * (height - z), 2);
    sum_x += stress[6 * p];
    sum_z += stress[6 * p + 2];
    moved -= u[3 * p + 2];
    should += density * g * (height * z - 0.5 * z * z) / modulus;
  }
  column.stress_error = std::sqrt(error2 / static_cast<double>(column.z.size())) / base_pressure;
  column.lateral = sum_x / sum_z;
  column.settlement_error = moved / should - 1.0;
  return column;
}

} // namespace

CaseReport column_case(Effort) {
  Convergence convergence = {"stress", {}, {}};
  Column column;
  for (const int cells : {8, 16, 32}) {
    column = settle(cells);
    convergence.cell_size.push_back(1.0 / cells);
    convergence.error.push_back(column.stress_error);
  }
  const std::string source = "equilibrium and uniaxial strain; apps/bench/case_column.cpp";
  CaseReport report;
  report.checks = {
      {"stress_error_32_cells", column.stress_error, 0.0, 0.01, Bound::absolute, "-",
       "s_zz = - rho g (H - z)", "root mean square over the points, parts of the base's stress"},
      {"stress_order", convergence.order(), 1.0, 0.9, Bound::at_least, "-",
       "linear functions: stress constant in a cell, of first order"},
      {"lateral_stress", column.lateral, nu / (1.0 - nu), 1e-3, Bound::relative, "-", source},
      {"settlement", column.settlement_error, 0.0, 0.005, Bound::absolute, "-", source,
       "mean over the column, 32 cells"}};
  render::Curve measured = {.label = "scarp, 32 cells",
                            .x = {},
                            .y = column.z,
                            .line = render::LineKind::none,
                            .marker = render::Marker::circle,
                            .weight = 0.7};
  for (const double pressure : column.pressure) measured.x.push_back(1e-3 * pressure);
  report.figure = {
      {{{.label = "ρ g (H − z)", .x = {1e-3 * base_pressure, 0.0}, .y = {0.0, height}}, measured},
       {.x_name = "vertical pressure",
        .x_unit = "kPa",
        .y_name = "height",
        .y_unit = "m",
        .title = "Stress"}},
      convergence_chart({convergence}, {1.0}, "cell size / height", "rms error / base's stress",
                        "Error")};
  report.caption = "A column at rest under its own weight.";
  report.convergence = {std::move(convergence)};
  return report;
}

} // namespace scarp::bench
