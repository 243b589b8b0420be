// Strength reduction: the search, the weaker material, and the verdict on blocks.
#include "apps/safety.hpp"
#include "apps/safety_search.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace scarp::apps {
namespace {

/// Keeps what was tried.
struct Oracle {
  std::function<bool(double)> fails;
  std::vector<double> tried = {};

  Bracket search(const SearchOptions& options) {
    return find_bracket(options, [&](double factor) {
      tried.push_back(factor);
      return fails(factor);
    });
  }
};

/// A vertical face of soil on a fixed base, gamma H = 20 kPa, without friction: it stands up to
/// 4 c / (gamma H) at least, within cells of a quarter of its height.
Scene block(double cohesion) {
  Scene scene;
  scene.grid = test::grid_2d(0.25, {0.0, 0.0}, {3.0, 2.0});
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.gravity = {0.0, 0.0, -10.0};
  DruckerPrager law;
  law.cohesion = cohesion;
  law.cone = Cone::plane_strain;
  scene.materials = {{"soil", 2000.0, 1e7, 0.3, law}};
  scene.regions = {test::box("block", "soil", {0.0, 0.0}, {1.0, 1.0})};
  scene.monitors = {{"shoulder", {1.0, 0.0, 1.0}}};
  return scene;
}

Trial try_factor(const Scene& scene, double factor) {
  StrengthReduction body(scene);
  body.settle();
  return body.try_factor(factor, [](double, double) {});
}

} // namespace

TEST(SafetySearch, BracketsWhereABodyBeginsToFail) {
  for (const double limit : {0.26, 1.37, 2.0, 3.995}) {
    Oracle oracle{[&](double factor) { return factor >= limit; }};
    const SearchOptions options;
    const Bracket bracket = oracle.search(options);
    SCOPED_TRACE(limit);
    ASSERT_TRUE(bracket.stable && bracket.failed);
    EXPECT_LT(*bracket.stable, limit);
    EXPECT_GE(*bracket.failed, limit);
    EXPECT_LE(*bracket.failed - *bracket.stable, options.tolerance);
    EXPECT_TRUE(bracket.monotone);
    std::ranges::sort(oracle.tried);
    EXPECT_EQ(std::ranges::adjacent_find(oracle.tried), oracle.tried.end()) << "each once";
    EXPECT_EQ(oracle.tried.front(), options.lower);
    EXPECT_EQ(oracle.tried.back(), options.upper);
  }
}

TEST(SafetySearch, TellsWhenTheFactorLiesBeyondAnEnd) {
  Oracle weak{[](double) { return true; }};
  const Bracket below = weak.search({});
  EXPECT_FALSE(below.stable);
  EXPECT_EQ(below.failed, 0.25);
  EXPECT_TRUE(below.monotone);
  Oracle strong{[](double) { return false; }};
  const Bracket above = strong.search({});
  EXPECT_EQ(above.stable, 4.0);
  EXPECT_FALSE(above.failed);
}

TEST(SafetySearch, ReportsAStrongerBodyThatFails) {
  Oracle reversed{[](double factor) { return factor < 1.0; }};
  EXPECT_FALSE(reversed.search({}).monotone);
  // Halving goes 1.5, 1.25, 1.375, 1.4375; a tolerance below 1.375 is within the island.
  Oracle island{[](double factor) { return factor > 1.43 || (factor > 1.26 && factor < 1.35); }};
  const Bracket bracket = island.search({.lower = 1.0, .upper = 2.0, .tolerance = 0.1});
  EXPECT_FALSE(bracket.monotone);
  EXPECT_EQ(bracket.stable, 1.25);
  EXPECT_DOUBLE_EQ(*bracket.failed, 1.275);
}

TEST(SafetySearch, RefusesOptionsWithoutSense) {
  Oracle oracle{[](double) { return true; }};
  for (const SearchOptions& options :
       {SearchOptions{0.0, 1.0, 0.1}, SearchOptions{1.0, 1.0, 0.1}, SearchOptions{1.0, 2.0, 0.0}})
    EXPECT_THROW(oracle.search(options), std::invalid_argument);
  EXPECT_TRUE(oracle.tried.empty());
}

TEST(StrengthReduction, DividesCohesionAndTheTangentOfTheFrictionAngle) {
  constexpr double degree = std::numbers::pi / 180.0;
  DruckerPrager law;
  law.cohesion = 10e3;
  law.friction_angle = 30.0;
  law.dilation_angle = 20.0;
  const Material soil = {"soil", 2000.0, 1e7, 0.3, law};
  const auto weaker = [&](double factor) {
    return std::get<DruckerPrager>(reduced(soil, factor).law);
  };
  EXPECT_DOUBLE_EQ(weaker(1.6).cohesion, 10e3 / 1.6);
  EXPECT_DOUBLE_EQ(std::tan(weaker(1.6).friction_angle * degree), std::tan(30.0 * degree) / 1.6);
  EXPECT_DOUBLE_EQ(weaker(1.5).dilation_angle, 20.0);
  EXPECT_DOUBLE_EQ(weaker(2.0).dilation_angle, weaker(2.0).friction_angle);
  EXPECT_NEAR(weaker(0.5).friction_angle, std::atan(2.0 * std::tan(30.0 * degree)) / degree, 1e-12);
  EXPECT_TRUE(std::holds_alternative<LinearElastic>(
      reduced(test::elastic("steel", 7800.0, 2e11, 0.3), 2.0).law));
}

TEST(StrengthReduction, ABlockStandsOrFails) {
  const Trial stands = try_factor(block(20e3), 1.0);
  EXPECT_EQ(stands.verdict, Verdict::stable);
  EXPECT_LT(stands.displacement, 1e-4);
  EXPECT_LT(stands.kinetic_energy, 1e-6);
  const Trial fails = try_factor(block(20e3), 10.0);
  EXPECT_EQ(fails.verdict, Verdict::failed);
  EXPECT_GT(fails.displacement, 0.005);
  ASSERT_EQ(fails.monitor_displacement.size(), 1U);
  EXPECT_GT(fails.monitor_displacement[0], 0.0);
  EXPECT_LE(fails.monitor_displacement[0], fails.displacement);
  // Weaker soil is the same as a larger factor, to the bit: only the ratio counts.
  EXPECT_EQ(try_factor(block(2e3), 1.0).displacement, fails.displacement);
}

TEST(StrengthReduction, TheLastStageHasTheReducedStrength) {
  Scene scene = block(20e3);
  scene.timing.output_interval = 1.0;
  scene.materials.push_back(test::elastic("elastic", 2000.0, 1e7, 0.3));
  Stage rise;
  rise.name = "rise";
  rise.duration = 1.0;
  rise.gravity.points = {{0.0, 0.0}, {0.5, 1.0}};
  rise.material = {{"block", "elastic"}};
  Stage last;
  last.name = "last";
  last.duration = 1.0;
  scene.stages = {rise, last};
  EXPECT_EQ(try_factor(scene, 2.0).verdict, Verdict::stable);
  // Five times the load, which takes some time to rise: no rest before.
  scene.stages.back().body_force["block"].points = {{0.0, 1.0}, {1.0, 5.0}};
  const Trial loaded = try_factor(scene, 2.0);
  EXPECT_EQ(loaded.verdict, Verdict::failed);
  EXPECT_NEAR(StrengthReduction(scene).period(), 4.0 / std::sqrt(1e7 / 2.6 / 2000.0), 1e-12);
}

TEST(StrengthReduction, RefusesASceneWithoutStrengthOrWithAGateToOpen) {
  Scene elastic = block(20e3);
  elastic.materials.front().law = LinearElastic{};
  EXPECT_THROW(StrengthReduction{elastic}, SetupError);
  Scene gated = block(20e3);
  gated.gates = {{"gate", 0, 1.0, 100.0}};
  StrengthReduction body(gated);
  EXPECT_THROW(body.settle(), SetupError);
}

} // namespace scarp::apps
