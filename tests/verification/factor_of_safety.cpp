// Factors of safety by strength reduction against a closed form and a published one.
#include "apps/safety.hpp"
#include "apps/safety_search.hpp"
#include "io/scene_file.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

using namespace scarp;
using namespace scarp::apps;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// The middle of the bracket.
double factor_of_safety(const Scene& scene, FailureRule rule, const SearchOptions& search) {
  StrengthReduction body(scene, rule);
  body.settle();
  const Bracket bracket = find_bracket(search, [&](double factor) {
    return body.try_factor(factor, [](double, double) {}).fails();
  });
  EXPECT_TRUE(bracket.stable && bracket.failed);
  EXPECT_TRUE(bracket.monotone);
  return 0.5 * (bracket.stable.value_or(0.0) + bracket.failed.value_or(0.0));
}

constexpr double slope_angle = 45.0 * degree;
constexpr double weight = 20e3; ///< N/m3

/// A layer 1 m thick and 6 m long on a rough plane: the plane is z = 0, gravity is inclined.
Scene layer(double cell_size, double cohesion, double friction_angle) {
  Scene scene;
  scene.grid = test::grid_2d(cell_size, {-1.0, 0.0}, {8.0, 2.0});
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.gravity = {10.0 * std::sin(slope_angle), 0.0, -10.0 * std::cos(slope_angle)};
  DruckerPrager law;
  law.cohesion = cohesion;
  law.friction_angle = friction_angle;
  law.cone = Cone::plane_strain;
  scene.materials = {{"soil", weight / 10.0, 1e8, 0.3, law}};
  scene.regions = {test::box("layer", "soil", {0.0, 0.0}, {6.0, 1.0})};
  return scene;
}

/// Slip along the base under a cover of `depth`: weight depth sin = k + q weight depth cos, where
/// q, k are those of c/F and tan(phi)/F.  Zero dilation makes the plastic flow a simple shear, in
/// which the deviatoric stress is one as well: tau is the shear stress on the base, and the mean
/// pressure is the pressure on it.
double slip_along_base(double depth, double cohesion, double friction_angle) {
  const double t = std::tan(friction_angle * degree);
  double lower = 0.1, upper = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double factor = 0.5 * (lower + upper);
    const double root = std::sqrt(9.0 + 12.0 * t * t / (factor * factor));
    const double strength =
        3.0 / (factor * root) * (cohesion + t * weight * depth * std::cos(slope_angle));
    (strength > weight * depth * std::sin(slope_angle) ? lower : upper) = factor;
  }
  return lower;
}

} // namespace

// The infinite slope, F = c / (gamma d sin(beta)) + tan(phi)/tan(beta) with d normal to it, for the
// cone's q and k.  The base's nodes are fixed: the layer shears within its lowest cells, under a
// cover of d - h/2.
TEST(FactorOfSafety, LayerOnAnInclinedPlane) {
  constexpr double cohesion = 16e3;
  constexpr double friction_angle = 20.0;
  const double exact = slip_along_base(1.0, cohesion, friction_angle);
  double error = exact;
  for (const double h : {0.25, 0.125}) {
    SCOPED_TRACE(h);
    const double measured = factor_of_safety(layer(h, cohesion, friction_angle), {},
                                             {.lower = 1.2, .upper = 2.0, .tolerance = 0.01});
    const double in_cells = slip_along_base(1.0 - 0.5 * h, cohesion, friction_angle);
    EXPECT_NEAR(measured, in_cells, 0.01 * in_cells); // measured: 0.3 %
    EXPECT_LT(std::abs(measured - exact), 0.6 * error) << "of first order";
    error = std::abs(measured - exact);
  }
}

// Griffiths & Lane 1999, example 1: 1.4; Bishop & Morgenstern 1960: 1.38.  Quadratic B-splines in
// cells of H/10; linear functions lock at zero dilation and give 1.57 there.
TEST(FactorOfSafety, HomogeneousSlopeOfGriffithsAndLane) {
  const Scene scene = io::read_scene(std::filesystem::path(SCARP_SOURCE_DIR) /
                                         "data/scenes/griffiths_lane_1999.toml",
                                     {"grid.cell_size_m=1"});
  const double factor =
      factor_of_safety(scene, {}, {.lower = 1.1, .upper = 1.9, .tolerance = 0.02});
  EXPECT_NEAR(factor, 1.40, 0.05);
}
