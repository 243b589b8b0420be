// The slope of Wu et al. 2017 in cells of 2.5 m: its initial stress by a static solve against that
// of 3 s of rising gravity and 3 s of damped rest.
#include "core/run.hpp"
#include "io/scene_file.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace scarp;

namespace {

/// The elastic stage of the scene, with this gravity.
std::unique_ptr<Simulation> slope(const std::string& shape, const std::string& gravity,
                                  const std::vector<std::string>& more) {
  std::vector<std::string> overrides = {"grid.cell_size_m=2.5", "method.shape=" + shape,
                                        "stage.initial_stress.duration_s=6",
                                        "stage.initial_stress.gravity=" + gravity};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return make_simulation(io::read_scene(
      std::filesystem::path(SCARP_SOURCE_DIR) / "data/scenes/wu2017.toml", overrides));
}

/// Of the largest stress component: how far those of the points are from the ramp's.
struct Difference {
  double worst = 0.0, rms = 0.0;
};

Difference from_ramp(const std::string& shape, const std::string& stiffness) {
  const auto ramp = slope(shape, "[[0, 0], [3, 1]]", {stiffness, "method.local_damping=0.2"});
  test::run_until(*ramp, 6.0);
  const auto solved = slope(shape, "1", {stiffness, "method.initial_stress=static"});
  const std::vector<double> expected = ramp->field("stress"), found = solved->field("stress");
  double largest = 0.0, squares = 0.0;
  Difference difference;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double error = std::abs(found[k] - expected[k]);
    largest = std::max(largest, std::abs(expected[k]));
    difference.worst = std::max(difference.worst, error);
    squares += error * error;
  }
  EXPECT_GT(largest, 0.8 * 2000.0 * 9.8 * 40.0);
  return {difference.worst / largest,
          std::sqrt(squares / static_cast<double>(found.size())) / largest};
}

class StaticSlope : public testing::TestWithParam<std::string> {};

} // namespace

INSTANTIATE_TEST_SUITE_P(Shapes, StaticSlope, testing::Values("linear", "bspline"),
                         [](const auto& test) { return test.param; });

/// The slope that has come down under its weight is another than the given one by strains of
/// rho g H / M = 0.8 %: 0.5 % RMS is allowed.  2 % of the largest at any point was too little to
/// allow: at the face, where triangles share cells with squares, it is 3.5 %.  But it is of the
/// first order in the strain, as ten times the stiffness shows.  Measured, worst and RMS: linear
/// 3.5, 0.20 %, then 0.34, 0.016 %; B-splines 2.2, 0.06 %, then 0.12, 0.004 %.
/// (Not so with GIMP: its points just touch nodes beyond the face, and reach them once they move.)
TEST_P(StaticSlope, HasTheStressThatARampLeaves) {
  const Difference soft = from_ramp(GetParam(), "material.elastic.youngs_modulus_Pa=70e6");
  const Difference stiff = from_ramp(GetParam(), "material.elastic.youngs_modulus_Pa=700e6");
  EXPECT_LE(soft.rms, 0.005);
  EXPECT_LE(stiff.worst, 0.02);
  EXPECT_LE(stiff.worst, 0.2 * soft.worst);
  EXPECT_LE(stiff.rms, 0.2 * soft.rms);
}

/// Undamped for a second; the first period in shear is 1.2 s.
TEST_P(StaticSlope, StaysAtRest) {
  const auto solved = slope(GetParam(), "1", {"method.initial_stress=static"});
  test::run_until(*solved, 1.0);
  const double scale = test::sum(test::masses(*solved)) * 9.8 * 40.0; // m g H
  EXPECT_LE(solved->energies().kinetic, 1e-12 * scale);
}
