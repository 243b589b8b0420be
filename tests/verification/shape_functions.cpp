// What must hold of any shape functions, transfer and volume rate: equilibrium under gravity and a
// collapse that makes no energy.
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace scarp;
using namespace scarp::test;

namespace {

struct Choice {
  const char* name;
  Scheme scheme;
  ShapeFunctions shape;
  VolumeRate volume_rate;
  VelocityTransfer transfer;
  double most_loss; ///< of gravity's work, to the scheme; APIC, a filter, measured 16 %
};

constexpr Choice choices[] = {
    {"linear", Scheme::musl, ShapeFunctions::linear, VolumeRate::point, VelocityTransfer::flip,
     0.05},
    {"linear_average", Scheme::musl, ShapeFunctions::linear, VolumeRate::cell_average,
     VelocityTransfer::flip, 0.05},
    {"gimp", Scheme::musl, ShapeFunctions::gimp, VolumeRate::point, VelocityTransfer::flip, 0.05},
    {"gimp_average", Scheme::musl, ShapeFunctions::gimp, VolumeRate::cell_average,
     VelocityTransfer::flip, 0.05},
    {"bspline", Scheme::musl, ShapeFunctions::bspline, VolumeRate::point, VelocityTransfer::flip,
     0.05},
    {"bspline_average", Scheme::musl, ShapeFunctions::bspline, VolumeRate::cell_average,
     VelocityTransfer::flip, 0.05},
    {"bspline_apic", Scheme::usl, ShapeFunctions::bspline, VolumeRate::point,
     VelocityTransfer::apic, 0.25},
};

class ShapeFunctionChoice : public testing::TestWithParam<Choice> {
 protected:
  static void choose(Scene& scene) {
    scene.method.scheme = GetParam().scheme;
    scene.method.shape = GetParam().shape;
    scene.method.volume_rate = GetParam().volume_rate;
    scene.method.transfer = GetParam().transfer;
  }
};

INSTANTIATE_TEST_SUITE_P(Method, ShapeFunctionChoice, testing::ValuesIn(choices),
                         [](const auto& choice) { return std::string(choice.param.name); });

} // namespace

/// An elastic layer of height H between smooth walls comes to rest under sigma_zz = - rho g (H -
/// z), sigma_xx = nu / (1 - nu) sigma_zz.  Points within a cell of base or surface see half a cell
/// of either, so they are left out.
TEST_P(ShapeFunctionChoice, LayerUnderItsOwnWeight) {
  constexpr double height = 2.0, rho = 2000.0, g = 9.81, nu = 0.25, h = 0.2;
  Scene scene;
  scene.grid = grid_2d(h, {0.0, 0.0}, {1.0, 3.0});
  scene.grid.walls[0] = {Wall{WallKind::symmetry}, Wall{WallKind::symmetry}};
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.gravity = {0.0, 0.0, -g};
  scene.materials = {elastic("soil", rho, 20e6, nu)};
  scene.regions = {box("layer", "soil", {0.0, 0.0}, {1.0, height})};
  scene.method.local_damping = 0.7;
  choose(scene);
  const auto simulation = make_simulation(scene);
  run_until(*simulation, 1.0); // 11 periods, 4 H / c = 0.073 s
  const auto x = simulation->positions();
  const auto stress = simulation->field("stress");
  const double largest = rho * g * height;
  for (std::size_t p = 0; p < simulation->points(); ++p) {
    const double z = x[3 * p + 2];
    if (z < h || z > height - h) continue;
    const double vertical = -rho * g * (height - z);
    EXPECT_NEAR(stress[6 * p + 2], vertical, 0.03 * largest) << "z = " << z;
    EXPECT_NEAR(stress[6 * p], nu / (1.0 - nu) * vertical, 0.02 * largest) << "z = " << z;
    EXPECT_NEAR(stress[6 * p + 5], 0.0, 0.01 * largest) << "z = " << z;
  }
}

/// The rods of Bui et al. 2008 in cells of 5 mm, without PIC: no energy but gravity's, nothing
/// thrown ahead of a body that falls freely.
TEST_P(ShapeFunctionChoice, CollapseMakesNoEnergy) {
  Scene scene = pile(0.2, 0.1, 0.005, 0.6, 0.15);
  std::get<DruckerPrager>(scene.materials[0].law).opening = Opening::remembered;
  choose(scene);
  const auto simulation = make_simulation(scene);
  for (int frame = 1; frame <= 6; ++frame) {
    ASSERT_NO_THROW(run_until(*simulation, 0.05 * frame));
    const Energies e = simulation->energies();
    EXPECT_GT(e.scheme_loss, -0.005 * e.gravity_work) << "at " << simulation->time() << " s";
    EXPECT_LT(e.scheme_loss, GetParam().most_loss * e.gravity_work)
        << "at " << simulation->time() << " s";
  }
  EXPECT_LT(simulation->front(), 0.2 + 0.3 * std::sqrt(2.0 * 9.81 * 0.1));
  EXPECT_GT(simulation->front(), 0.3);
}
