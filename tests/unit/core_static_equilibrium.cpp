// Initial stress by a static solve: closed forms, rest, what is refused.
#include "core/error.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr double height = 2.0, h = 0.2, density = 2000.0, g = 9.8;
constexpr double base_stress = density * g * height; // Pa

struct Variant {
  ShapeFunctions shape;
  VolumeRate rate;
  VelocityTransfer transfer = VelocityTransfer::flip;
};

std::string name_of(const Variant& variant) {
  std::string name = variant.shape == ShapeFunctions::linear ? "linear"
                     : variant.shape == ShapeFunctions::gimp ? "gimp"
                                                             : "bspline";
  if (variant.rate == VolumeRate::cell_average) name += "_averaged";
  if (variant.transfer == VelocityTransfer::apic) name += "_apic";
  return name;
}

Scene with(Scene scene, const Variant& variant) {
  scene.method.shape = variant.shape;
  scene.method.volume_rate = variant.rate;
  scene.method.transfer = variant.transfer;
  scene.method.initial_stress = InitialStress::equilibrium;
  return scene;
}

/// An elastic column between smooth sides on a smooth base; E = 50 MPa, nu = 0.25.
Scene column(int dimension) {
  Scene scene;
  scene.grid = dimension == 2 ? grid_2d(h, {0.0, 0.0}, {h, height + 2.0 * h})
                              : grid_3d(h, {0.0, 0.0, 0.0}, {2.0 * h, h, height + 2.0 * h});
  for (const std::size_t axis : {0U, 1U, 2U})
    for (std::size_t side = 0; side < (axis == 2 ? 1U : 2U); ++side)
      scene.grid.walls[axis][side].kind = WallKind::symmetry;
  scene.materials = {elastic("soil", density, 50e6, 0.25)};
  scene.gravity = {0.0, 0.0, -g};
  scene.regions = {
      box("column", "soil", {0.0, 0.0}, {dimension == 2 ? h : 2.0 * h, height}, {}, {0.0, h})};
  return scene;
}

/// Rods between a smooth wall and a gate that opens at 1 s.
Scene held_pile() {
  Scene scene = pile(0.1, 0.05, 0.005, 0.2, 0.06);
  scene.gates = {{"gate", 0, 0.1, 1.0}};
  scene.method.initial_stress = InitialStress::equilibrium;
  return scene;
}

/// m g H, J
double potential_scale(const Simulation& simulation, double over) {
  return sum(masses(simulation)) * 9.81 * over;
}

/// Whether `steps` steps give no more motion than rounding would: a residual r of the loads leaves
/// about r^2 of the strain energy, which is far below m g H.
void expect_rest(Simulation& simulation, double over, int steps) {
  for (int k = 0; k < steps; ++k) simulation.step(std::numeric_limits<double>::infinity());
  EXPECT_LE(simulation.energies().kinetic, 1e-12 * potential_scale(simulation, over));
}

Stage stage(const std::string& name, const Ramp& gravity = {}) {
  Stage made;
  made.name = name;
  made.duration = 1.0;
  made.gravity = gravity;
  return made;
}

std::string refusal(const Scene& scene) {
  try {
    make_simulation(scene);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

std::string plan_line(const Simulation& simulation) {
  const std::vector<PlanLine> plan = simulation.plan();
  return std::ranges::find(plan, "initial stress", &PlanLine::what)->how;
}

} // namespace

class StaticColumn : public testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(Methods, StaticColumn,
                         testing::Values(Variant{ShapeFunctions::linear, VolumeRate::point},
                                         Variant{ShapeFunctions::linear, VolumeRate::cell_average},
                                         Variant{ShapeFunctions::gimp, VolumeRate::point},
                                         Variant{ShapeFunctions::gimp, VolumeRate::cell_average},
                                         Variant{ShapeFunctions::bspline, VolumeRate::point},
                                         Variant{ShapeFunctions::bspline, VolumeRate::cell_average},
                                         Variant{ShapeFunctions::bspline, VolumeRate::point,
                                                 VelocityTransfer::apic}),
                         [](const auto& test) { return name_of(test.param); });

/// sigma_zz = - rho g (H - z), sigma_xx = sigma_yy = nu / (1 - nu) sigma_zz = sigma_zz / 3, within
/// the weight of half a cell.  Linear functions have the stress of a cell's middle, exactly.
TEST_P(StaticColumn, StressIsTheOverburden) {
  const bool linear = GetParam().shape == ShapeFunctions::linear;
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const auto simulation = make_simulation(with(column(dimension), GetParam()));
    const auto stress = simulation->field("stress");
    const auto x = simulation->positions();
    double worst = 0.0, worst_side = 0.0, shear = 0.0;
    for (std::size_t p = 0; p < simulation->points(); ++p) {
      const double* s = &stress[6 * p];
      const double z = linear ? (std::floor(x[3 * p + 2] / h) + 0.5) * h : x[3 * p + 2];
      worst = std::max(worst, std::abs(s[2] + density * g * (height - z)));
      for (const std::size_t side : {0U, 1U})
        worst_side = std::max(worst_side, std::abs(s[side] - s[2] / 3.0));
      for (const std::size_t component : {3U, 4U, 5U})
        shear = std::max(shear, std::abs(s[component]));
    }
    const double half_a_cell = 0.5 * density * g * h;
    EXPECT_LE(worst, linear ? 1e-9 * base_stress : half_a_cell);
    EXPECT_LE(worst_side,
              linear || GetParam().rate == VolumeRate::point ? 1e-9 * base_stress : half_a_cell);
    EXPECT_LE(shear, 1e-9 * base_stress);
  }
}

TEST_P(StaticColumn, StaysAtRest) {
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const auto simulation = make_simulation(with(column(dimension), GetParam()));
    const double strain = simulation->energies().strain;
    EXPECT_GT(strain, 0.0);
    EXPECT_EQ(simulation->energies().scheme_loss, 0.0) << "what is there at time 0 is no gain";
    for (const double u : simulation->field("displacement")) EXPECT_EQ(u, 0.0);
    for (const double rho : simulation->field("density")) EXPECT_NEAR(rho, density, 1e-9 * density);
    expect_rest(*simulation, height, 300);
    EXPECT_LE(std::abs(simulation->energies().scheme_loss), 1e-9 * strain);
  }
}

/// Corners, a load that is askew, two stiffnesses: no closed form, but no motion either.
TEST_P(StaticColumn, BodiesOfAnyShapeStayAtRest) {
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    Scene scene;
    scene.grid = dimension == 2 ? grid_2d(0.5, {0.0, 0.0}, {6.0, 4.0})
                                : grid_3d(0.5, {0.0, 0.0, 0.0}, {6.0, 2.0, 4.0});
    scene.grid.walls[2][0].kind = WallKind::fixed;
    scene.grid.walls[0][0].kind = WallKind::symmetry;
    scene.materials = {elastic("rock", 2500.0, 1e9, 0.2), elastic("clay", 1500.0, 1e6, 0.45)};
    scene.gravity = {3.0, 0.0, -9.0};
    Region wedge = box("wedge", "rock", {0.0, 0.0}, {0.0, 0.0}, {}, {0.1, 1.6});
    wedge.polygon = {{0.0, 0.0}, {5.0, 0.0}, {1.3, 2.1}, {0.0, 2.1}};
    scene.regions = {wedge, box("top", "clay", {0.0, 2.25}, {1.2, 3.4}, {}, {0.0, 1.2})};
    scene.stages = {stage("only")};
    scene.stages[0].body_force = {{"top", {{{0.0, 2.0}}}}};
    const auto simulation = make_simulation(with(scene, GetParam()));
    expect_rest(*simulation, 3.4, 100);
  }
}

TEST(StaticEquilibrium, IsSaidInThePlan) {
  Scene scene = column(2);
  EXPECT_EQ(plan_line(*make_simulation(scene)), "none, skipped");
  scene.method.initial_stress = InitialStress::equilibrium;
  EXPECT_NE(plan_line(*make_simulation(scene)).find("static equilibrium, 20 unknowns, "),
            std::string::npos)
      << "sides and base hold all but the vertical components of 2 x 10 nodes";
  scene.stages = {stage("only", {{{0.0, 0.0}, {1.0, 1.0}}})};
  const auto unloaded = make_simulation(scene);
  EXPECT_EQ(plan_line(*unloaded), "static equilibrium without a load: none");
  for (const double stress : unloaded->field("stress")) EXPECT_EQ(stress, 0.0);
}

/// Forces of Scene::body_force count as gravity does.
TEST(StaticEquilibrium, BearsTheForcesOfPrograms) {
  Scene scene = column(2);
  scene.method.initial_stress = InitialStress::equilibrium;
  const std::vector<double> expected = make_simulation(scene)->field("stress");
  scene.gravity = {0.0, 0.0, -0.5 * g};
  scene.body_force = [](const auto&, double) { return std::array{0.0, 0.0, -0.5 * g}; };
  const std::vector<double> found = make_simulation(scene)->field("stress");
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k], expected[k], 1e-9 * base_stress);
}

/// Single precision only rounds the result.
TEST(StaticEquilibrium, InSinglePrecision) {
  for (const ShapeFunctions shape : {ShapeFunctions::linear, ShapeFunctions::bspline}) {
    Scene scene = with(column(2), {shape, VolumeRate::point});
    const std::vector<double> exact = make_simulation(scene)->field("stress");
    scene.method.precision = Precision::single;
    const auto simulation = make_simulation(scene);
    const std::vector<double> rough = simulation->field("stress");
    for (std::size_t k = 0; k < exact.size(); ++k)
      EXPECT_NEAR(rough[k], exact[k], 1e-6 * base_stress);
    expect_rest(*simulation, height, 300);
  }
}

/// K0 = nu / (1 - nu) lies outside the cone of 19.8 degrees: all of it yields.
TEST(StaticEquilibrium, APileBehindAGateIsAdmissibleAndStays) {
  for (const Opening opening : {Opening::forgotten, Opening::remembered}) {
    Scene scene = held_pile();
    auto& law = std::get<DruckerPrager>(scene.materials[0].law);
    law.opening = opening;
    const auto simulation = make_simulation(scene);
    const double sine = std::sin(19.8 * 3.14159265358979323846 / 180.0);
    const double q = 6.0 * sine / (std::sqrt(3.0) * (3.0 + sine));
    const double scale = 2650.0 * 9.81 * 0.05;
    const std::vector<double> mean = simulation->field("mean_stress");
    const std::vector<double> deviatoric = simulation->field("deviatoric_stress");
    std::size_t at_yield = 0;
    for (std::size_t p = 0; p < mean.size(); ++p) {
      EXPECT_LE(mean[p], 1e-9 * scale);
      EXPECT_LE(deviatoric[p] + q * mean[p], 1e-9 * scale);
      at_yield += deviatoric[p] + q * mean[p] > -1e-9 * scale ? 1U : 0U;
    }
    EXPECT_GT(at_yield, mean.size() / 4);
    for (const char* history : {"equivalent_plastic_strain", "gap", "displacement"})
      for (const double value : simulation->field(history)) EXPECT_EQ(value, 0.0) << history;
    EXPECT_EQ(simulation->energies().plastic, 0.0);
    expect_rest(*simulation, 0.05, 200);
  }
}

TEST(StaticEquilibrium, IsTheSameToTheBitForAnyNumberOfThreads) {
  std::vector<std::vector<double>> stress;
  for (const int count : {1, 2}) {
    const Threads threads(count);
    stress.push_back(make_simulation(held_pile())->field("stress"));
  }
  EXPECT_EQ(stress[0], stress[1]);
}

TEST(StaticEquilibrium, RefusesWhatNothingHolds) {
  for (const int dimension : {2, 3}) {
    Scene floating = column(dimension);
    floating.method.initial_stress = InitialStress::equilibrium;
    floating.grid.walls[2][0].kind = WallKind::free;
    for (const char* words : {"100 % of the loads", "walls and gates do not hold the body",
                              "let gravity rise in a [[stage]]"})
      EXPECT_NE(refusal(floating).find(words), std::string::npos) << refusal(floating);
  }

  Scene sliding = pile(0.1, 0.1, 0.02, 0.3, 0.2);
  sliding.materials = {elastic("rods", 2650.0, 0.84e6, 0.3)};
  sliding.method.initial_stress = InitialStress::equilibrium;
  sliding.grid.walls[0][0].kind = WallKind::free;
  sliding.grid.walls[2][0] = {WallKind::friction, 1.0};
  ASSERT_EQ(refusal(sliding), "") << "nothing pushes it along the base";
  expect_rest(*make_simulation(sliding), 0.1, 200);
  sliding.gravity = {1.0, 0.0, -9.81};
  EXPECT_NE(refusal(sliding).find("do not hold"), std::string::npos);
}

/// Rods without cohesion cannot stand upright.
TEST(StaticEquilibrium, RefusesWhatYieldsWithoutEnd) {
  Scene scene = pile(0.1, 0.1, 0.02, 0.3, 0.2);
  scene.method.initial_stress = InitialStress::equilibrium;
  for (const char* words : {"at its strength", "the body fails", "[[stage]]"})
    EXPECT_NE(refusal(scene).find(words), std::string::npos) << refusal(scene);
}

TEST(StaticEquilibrium, IsNotThatOfARunThatGoesOn) {
  Scene scene = column(2);
  scene.method.initial_stress = InitialStress::equilibrium;
  scene.stages = {stage("first"), stage("second")};
  const auto whole = make_simulation(scene);
  const auto n = whole->points();
  const Snapshot start = {.time = 1.0,
                          .steps = 1,
                          .position = whole->positions(),
                          .displacement = whole->field("displacement"),
                          .velocity = whole->field("velocity"),
                          .stress = std::vector<double>(6 * n, 1.0),
                          .volume = whole->field("volume"),
                          .initial_volume = whole->field("initial_volume"),
                          .plastic_strain = std::vector<double>(n, 0.0),
                          .gap = std::vector<double>(n, 0.0),
                          .velocity_gradient = whole->field("velocity_gradient")};
  scene.stages[1].begin_from = "elsewhere";
  const auto continued = make_simulation(scene, &start);
  EXPECT_EQ(plan_line(*continued), "that of the run it begins from");
  for (const double stress : continued->field("mean_stress")) EXPECT_EQ(stress, 1.0);
  scene.stages.erase(scene.stages.begin());
  EXPECT_THROW(make_simulation(scene, &start), SetupError) << "there is no time 0";
}
