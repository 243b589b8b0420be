// An elastic column between smooth sides comes to rest under its own weight.
//
// Equilibrium: sigma_zz = - rho g (H - z), sigma_xx = sigma_yy = nu / (1 - nu) sigma_zz.
// Settlement: strain sigma_zz / M from the base up, u(z) = - rho g (H z - z^2 / 2) / M; at the top
// rho g H^2 / 2M, with M = E (1 - nu) / ((1 + nu)(1 - 2 nu)).
// Energy: gravity's work is rho g u integrated, (rho g)^2 H^3 / 3M per area; the column keeps half
// of it as strain energy and damping has taken the other half (Clapeyron).
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr double height = 2.0, density = 2000.0, g = 9.8,
                 modulus = 60e6;                     // E = 50 MPa, nu = 0.25: M = 1.2 E
constexpr double base_stress = density * g * height; // Pa
constexpr double settlement = 0.5 * base_stress * height / modulus; // m

/// One cell wide, settled for 30 periods 4 H / c under local damping of 0.2.
std::unique_ptr<Simulation> settled(int cells, Scheme scheme) {
  const double h = height / cells;
  Scene scene;
  scene.grid = grid_2d(h, {0.0, 0.0}, {h, height + 2.0 * h});
  for (const auto& [axis, side] : {std::pair{0U, 0U}, {0U, 1U}, {2U, 0U}})
    scene.grid.walls[axis][side].kind = WallKind::symmetry;
  scene.materials = {elastic("soil", density, 50e6, 0.25)};
  scene.gravity = {0.0, 0.0, -g};
  scene.method.scheme = scheme;
  scene.method.local_damping = 0.2;
  scene.regions = {box("column", "soil", {0.0, 0.0}, {h, height})};
  auto simulation = make_simulation(scene);
  run_until(*simulation, 30.0 * 4.0 * height / std::sqrt(modulus / density));
  return simulation;
}

} // namespace

class SettlingColumn : public testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, SettlingColumn,
                         testing::Values(Scheme::usf, Scheme::usl, Scheme::musl),
                         [](const auto& test) {
                           return test.param == Scheme::usf   ? "usf"
                                  : test.param == Scheme::usl ? "usl"
                                                              : "musl";
                         });

/// Linear elements are exact at the nodes, and their stress is that of the middle of the cell. What
/// is left is the settlement's own effect on the grid, of the order of the strain rho g H / M
/// = 6.5e-4: measured 6.3e-4.
TEST_P(SettlingColumn, StressIsTheOverburden) {
  for (const int cells : {10, 20, 40}) {
    const double h = height / cells;
    const auto simulation = settled(cells, GetParam());
    const auto stress = simulation->field("stress");
    const auto x = simulation->positions();
    const auto u = simulation->field("displacement");
    double worst = 0.0, worst_side = 0.0;
    for (std::size_t p = 0; p < simulation->points(); ++p) {
      const double z = x[3 * p + 2] - u[3 * p + 2]; // where the point was
      const double middle = (std::floor(z / h) + 0.5) * h;
      worst = std::max(worst, std::abs(stress[6 * p + 2] + density * g * (height - middle)));
      for (const std::size_t side : {0U, 1U}) // xx and yy are nu / (1 - nu) = 1/3 of it
        worst_side = std::max(worst_side, std::abs(stress[6 * p + side] - stress[6 * p + 2] / 3.0));
      EXPECT_NEAR(stress[6 * p + 5], 0.0, 1e-6);
    }
    EXPECT_LT(worst / base_stress, base_stress / modulus);
    EXPECT_LT(worst_side / base_stress, 1e-12);
  }
}

/// Between the nodes u is interpolated on a chord of the parabola, whose sag at the quarter points
/// is 3/32 h^2 rho g / M = 3/16 (h/H)^2 of the settlement.  Measured with 10, 20, 40 cells
/// (MUSL): 2.31e-3, 9.1e-4, 5.6e-4 of the settlement; the sag is 1.88e-3, 4.7e-4, 1.2e-4, the rest
/// the effect of finite strain.
TEST_P(SettlingColumn, SettlementIsTheParabola) {
  for (const int cells : {10, 20, 40}) {
    const auto simulation = settled(cells, GetParam());
    const auto x = simulation->positions();
    const auto u = simulation->field("displacement");
    double worst = 0.0;
    for (std::size_t p = 0; p < simulation->points(); ++p) {
      const double z = x[3 * p + 2] - u[3 * p + 2];
      worst = std::max(worst,
                       std::abs(u[3 * p + 2] + density * g / modulus * (height * z - 0.5 * z * z)));
    }
    const double sag = 3.0 / 16.0 / (cells * cells);
    EXPECT_LT(worst / settlement, sag + base_stress / modulus) << cells << " cells";
  }
}

/// Measured (20 cells): strain 0.49995, damping 0.5000 (USL 0.4994),
/// the scheme 5e-5 (USL 6.6e-4) of the work.
TEST_P(SettlingColumn, DampingTakesHalfOfTheWork) {
  const Energies e = settled(20, GetParam())->energies();
  const double h = height / 20;
  const double work = h * std::pow(density * g, 2) * std::pow(height, 3) / (3.0 * modulus);
  EXPECT_NEAR(e.gravity_work / work, 1.0, 0.002);
  EXPECT_NEAR(e.strain / e.gravity_work, 0.5, 0.001);
  EXPECT_NEAR(e.damping / e.gravity_work, 0.5, 0.001);
  EXPECT_LT(std::abs(e.scheme_loss) / e.gravity_work, 0.001);
  EXPECT_LT(e.kinetic / e.gravity_work, 1e-6) << "at rest";
}
