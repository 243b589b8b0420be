// scarp stress: scenes that depend on seed and number only, and checks that can fail.
#include "apps/stress_run.hpp"
#include "io/scene_file.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/io_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

namespace scarp::apps {
namespace {

/// A block of one material at rest, whose bounds are worked out by hand below.
Scene block() {
  Scene scene;
  scene.grid = test::grid_2d(0.5, {0.0, 0.0}, {8.0, 4.0});
  scene.gravity = {0.0, 0.0, -10.0};
  scene.materials = {test::elastic("rock", 1000.0, 4e6, 0.0)}; // c = sqrt(4e6/1000) = 63.2 m/s
  scene.regions = {test::box("block", "rock", {1.0, 0.0}, {3.0, 1.0}, {3.0, 0.0, 4.0})};
  scene.timing.end_time = 1.0;
  scene.timing.output_interval = 1.0;
  return scene;
}

/// One point that does nothing.
StressMoment calm() {
  StressMoment moment;
  moment.time = 0.5;
  moment.energies.kinetic = 100.0;
  moment.position = {2.0, 0.0, 0.5};
  moment.velocity = {0.0, 0.0, 0.0};
  moment.mean_stress = {-1000.0};
  moment.volume = {0.25};
  moment.initial_volume = {0.25};
  moment.plastic_strain = {0.0};
  return moment;
}

/// The check that fails on a moment, or "".
std::string failing(const StressMoment& moment) {
  StressChecks checks(stress_limits(block()));
  const auto failure = checks.look(moment);
  return failure ? failure->check : "";
}

TEST(StressLimits, AreThoseOfTheHeader) {
  const StressLimits limits = stress_limits(block());
  EXPECT_EQ(limits.body_force, 10.0);
  EXPECT_EQ(limits.potential, 40.0); // 10 m/s2 over 4 m
  EXPECT_EQ(limits.speed, 5.0);
  EXPECT_NEAR(limits.fastest(0.1), 2.0 * 6.0, 1e-12);                    // v0 + b t
  EXPECT_NEAR(limits.fastest(9.0), 2.0 * std::sqrt(25.0 + 80.0), 1e-12); // the whole fall
  EXPECT_NEAR(limits.weight, 1000.0 * 10.0 * 3.0, 1e-9);                 // 2 m wide and 1 m high
  EXPECT_NEAR(limits.stress(2.0), 4.0 * std::sqrt(4e9) + 4.0 * 30000.0, 1e-6);
  EXPECT_EQ(limits.room, 32.0);
}

TEST(StressLimits, TakeTheLargestLoadAndTheDensities) {
  Scene scene = block();
  scene.materials.push_back(test::elastic("light", 10.0, 4e6, 0.0));
  Stage stage;
  stage.gravity.points = {{0.0, 0.0}, {1.0, 3.0}};
  stage.body_force = {{"block", {{{0.0, 1.0}, {1.0, 2.0}}}}};
  scene.stages = {stage};
  const StressLimits limits = stress_limits(scene);
  EXPECT_EQ(limits.body_force, 60.0);
  EXPECT_EQ(limits.density_ratio, 100.0);
}

/// nu = 0.4: r = 2/3, in plane strain (1 + 4/9)^2 + 4/9 = 2.5309; 3-D (1 + 8/9)^2 + 8/9.
TEST(StressLimits, CountWhatWavesDoAcross) {
  Scene scene = block();
  const double along = stress_limits(scene).fastest(0.1);
  scene.materials[0].poissons_ratio = 0.4;
  EXPECT_NEAR(stress_limits(scene).fastest(0.1), std::sqrt(2.5308642) * along, 1e-6);
  scene.grid.dimension = 3;
  EXPECT_NEAR(stress_limits(scene).fastest(0.1) / along, std::sqrt(4.4567901), 1e-6);
}

/// Why 2 v is no bound in plane strain: an elastic square with nu = 0.4 that meets a smooth wall.
TEST(StressLimits, AreHigherThanWhatASquareAtAWallDoes) {
  Scene scene;
  scene.grid = test::grid_2d(0.05, {0.0, 0.0}, {2.0, 4.0});
  scene.grid.walls[0][1] = {WallKind::symmetry};
  scene.materials = {test::elastic("rubber", 1000.0, 1e5, 0.4)};
  scene.regions = {test::box("square", "rubber", {0.95, 1.5}, {1.95, 2.5}, {0.7, 0.0, 0.0})};
  scene.method = method_of(Preset::accurate);
  scene.timing.end_time = 0.5;
  const auto simulation = make_simulation(scene);
  double fastest = 0.0;
  while (simulation->time() < 0.5) {
    simulation->step(0.5);
    const auto v = simulation->field("velocity");
    for (std::size_t p = 0; p < v.size(); p += 3)
      fastest = std::max(fastest, std::hypot(v[p], v[p + 2]));
  }
  EXPECT_GT(fastest, 2.1 * 0.7);
  EXPECT_LT(fastest, stress_limits(scene).fastest(0.5));
}

/// (1 + 1)^2 + 1 = 5; in 3-D (1 + 2)^2 + 2 = 11.
TEST(StressLimits, CountShearWhereASideHolds) {
  for (const WallKind kind : {WallKind::fixed, WallKind::friction}) {
    Scene scene = block();
    const double along = stress_limits(scene).fastest(0.1);
    scene.grid.walls[2][0] = {kind};
    EXPECT_NEAR(stress_limits(scene).fastest(0.1), std::sqrt(5.0) * along, 1e-9);
    scene.grid.dimension = 3;
    EXPECT_NEAR(stress_limits(scene).fastest(0.1), std::sqrt(11.0) * along, 1e-9);
  }
}

/// Why what waves of pressure do is no bound there: a block with nu = 0.1, for which that would be
/// 2.04 v, on a base that holds it, seen from which it moves at 14 degrees.
TEST(StressLimits, AreHigherThanWhatABlockOnAHeldBaseDoes) {
  Scene scene;
  scene.grid = test::grid_2d(0.05, {0.0, 0.0}, {2.0, 2.0});
  scene.grid.walls[2][0] = {WallKind::fixed};
  scene.materials = {test::elastic("rubber", 1000.0, 1e5, 0.1)};
  scene.regions = {test::box("block", "rubber", {0.5, 0.0}, {1.25, 0.9}, {0.4, 0.0, 0.1})};
  scene.method = method_of(Preset::accurate);
  scene.timing.end_time = 0.4;
  const double v = std::hypot(0.4, 0.1);
  const auto simulation = make_simulation(scene);
  double fastest = 0.0;
  while (simulation->time() < 0.4) {
    simulation->step(0.4);
    const auto now = simulation->field("velocity");
    for (std::size_t p = 0; p < now.size(); p += 3)
      fastest = std::max(fastest, std::hypot(now[p], now[p + 2]));
  }
  EXPECT_GT(fastest, 2.1 * v);
  EXPECT_LT(fastest, stress_limits(scene).fastest(0.4));
}

TEST(StressChecks, LetACalmPointBe) { EXPECT_EQ(failing(calm()), ""); }

TEST(StressChecks, FindWhatIsNoNumber) {
  for (std::vector<double> StressMoment::*const column :
       {&StressMoment::position, &StressMoment::velocity, &StressMoment::mean_stress,
        &StressMoment::volume}) {
    StressMoment bad = calm();
    (bad.*column)[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(failing(bad), "numbers");
  }
  StressMoment bad = calm();
  bad.energies.scheme_loss = std::numeric_limits<double>::infinity();
  EXPECT_EQ(failing(bad), "numbers");
}

TEST(StressChecks, FindAThrownPoint) {
  StressMoment bad = calm();
  bad.velocity = {0.0, 0.0, 19.9}; // bound 2 (5 + 10 0.5) = 20 m/s
  EXPECT_EQ(failing(bad), "");
  bad.velocity = {0.0, 0.0, -20.1};
  EXPECT_EQ(failing(bad), "speed");
}

TEST(StressChecks, FindAStressThatNothingExplains) {
  StressMoment bad = calm();
  for (const double sign : {1.0, -1.0}) {
    bad.mean_stress = {sign * 1.19e5}; // at rest: 4 rho b L = 1.2e5 Pa
    EXPECT_EQ(failing(bad), "");
    bad.mean_stress = {sign * 1.21e5};
    EXPECT_EQ(failing(bad), "stress");
  }
}

TEST(StressChecks, FindImpossibleVolumes) {
  StressMoment bad = calm();
  bad.mean_stress = {0.0};
  bad.volume = {33.0}; // the grid has 32 m2
  EXPECT_EQ(failing(bad), "volume");
  // K = 4e6/3 Pa: exp(-1.2e5/K)/2 = 0.457
  bad.volume = {0.25 * 0.46};
  EXPECT_EQ(failing(bad), "");
  bad.volume = {0.25 * 0.45};
  EXPECT_EQ(failing(bad), "volume");
}

/// A quarter of a lattice square, 0.0625 m2 in block(), may be (2/(1 + 1/2))^2 times as fast and
/// twice as stressed.
TEST(StressChecks, AllowACutSquareWhatImpactAndHornGive) {
  StressMoment cut = calm();
  cut.energies.kinetic = 1e9;
  cut.volume = cut.initial_volume = {0.0625 / 4.0};
  cut.velocity = {0.0, 0.0, 35.5}; // 16/9 times 20 m/s
  EXPECT_EQ(failing(cut), "");
  cut.velocity = {0.0, 0.0, 35.6};
  EXPECT_EQ(failing(cut), "speed");
  cut.velocity = {0.0, 0.0, 0.0};
  cut.mean_stress = {-2.39e5}; // twice 1.2e5 Pa
  EXPECT_EQ(failing(cut), "");
  cut.mean_stress = {-2.41e5};
  EXPECT_EQ(failing(cut), "stress");
}

/// With 1.1 times 100 J/m at hand 1e-3 m2 of 1000 kg/m3 have at most sqrt(220) = 14.8 m/s of their
/// own, less than 20 m/s; 4e-4 m2 23.5 m/s, less than the impacts' 3.4 times 20 m/s.
TEST(StressChecks, AllowACutSquareNoMoreThanAllEnergy) {
  StressMoment cut = calm();
  cut.volume = cut.initial_volume = {1e-3};
  cut.velocity = {0.0, 0.0, 19.9};
  EXPECT_EQ(failing(cut), "");
  cut.velocity = {0.0, 0.0, 20.1};
  EXPECT_EQ(failing(cut), "speed");
  cut.volume = cut.initial_volume = {4e-4};
  cut.velocity = {0.0, 0.0, 23.4};
  EXPECT_EQ(failing(cut), "");
  cut.velocity = {0.0, 0.0, 23.6};
  EXPECT_EQ(failing(cut), "speed");
}

/// q_psi of the plane-strain cone is 3 tan/sqrt(9 + 12 tan^2), 0.5 where tan(psi)^2 = 3/8.
TEST(StressChecks, AllowWhatADilationAngleAdds) {
  Scene scene = block();
  DruckerPrager soil;
  soil.cone = Cone::plane_strain;
  soil.friction_angle = soil.dilation_angle =
      std::atan(std::sqrt(0.375)) * 180.0 / 3.14159265358979323846;
  scene.materials[0].law = soil;
  StressMoment dilated = calm();
  dilated.mean_stress = {0.0};
  dilated.plastic_strain = {2.0};
  const double most = 32.0 * std::exp(0.5 * std::sqrt(3.0) * 2.0);
  dilated.volume = {0.999 * most};
  EXPECT_FALSE(StressChecks(stress_limits(scene)).look(dilated));
  dilated.volume = {1.001 * most};
  EXPECT_TRUE(StressChecks(stress_limits(scene)).look(dilated));
}

TEST(StressChecks, FindTooManySteps) {
  StressMoment bad = calm();
  bad.steps = 100000;
  EXPECT_EQ(failing(bad), "steps");
}

TEST(StressChecks, FindALossThatGives) {
  for (double Energies::*const loss :
       {&Energies::damping, &Energies::wall_friction, &Energies::plastic}) {
    StressMoment bad = calm();
    StressChecks checks(stress_limits(block()));
    EXPECT_FALSE(checks.look(bad));
    bad.energies.*loss = -9.9; // of 100 J
    EXPECT_FALSE(checks.look_at_energy(bad, 0.0));
    bad.energies.*loss = -10.1;
    const auto failure = checks.look_at_energy(bad, 0.0);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->check, "losses");
  }
}

/// A mass on a spring, with steps near the stable ones: T + U swings about more than it began with,
/// the centred energy stays.
TEST(StressChecks, EnergyOfLeapfrogIsCentred) {
  const double m = 2.0, w = 3.0, dt = 1.8 / w;
  double x = 1.0, v = 0.0, largest = 0.0;
  const double first = 0.5 * m * w * w;
  StressMoment before;
  for (int n = 0; n < 200; ++n) {
    StressMoment now = calm();
    now.mass = {m};
    now.velocity = {0.0, 0.0, v};
    now.gradient.assign(9, 0.0);
    now.energies.kinetic = 0.5 * m * v * v;
    now.energies.scheme_loss = first - now.energies.kinetic - 0.5 * m * w * w * x * x;
    if (n > 0) {
      EXPECT_NEAR(centred_loss(before, now.velocity, now.gradient, 1.0), 0.0, 1e-12 * first) << n;
    }
    largest = std::max(largest, -now.energies.scheme_loss);
    before = now;
    v -= dt * w * w * x;
    x += dt * v;
  }
  EXPECT_GT(largest, first);
}

/// Energy comes for longer than a swing of leapfrog's.
TEST(StressChecks, FindMadeEnergyButNoSwing) {
  StressChecks lasting(stress_limits(block()));
  StressChecks swinging(stress_limits(block()));
  StressMoment moment = calm();
  std::string found;
  EXPECT_FALSE(lasting.look(moment));
  EXPECT_FALSE(swinging.look(moment));
  for (std::size_t i = 0; i < 2 * energy_window; ++i) {
    if (const auto failure = lasting.look_at_energy(moment, i == 0 ? 0.0 : -10.5))
      found = failure->check;
    EXPECT_FALSE(swinging.look_at_energy(moment, i % 2 == 0 ? -30.0 : 30.0));
  }
  EXPECT_EQ(found, "energy");
}

/// Energy put in and taken out between two looks has been there.
TEST(StressChecks, KnowWhatEveryStepPutsIn) {
  StressChecks checks(stress_limits(block()));
  StressMoment moment = calm();
  EXPECT_FALSE(checks.look(moment));
  Energies between = moment.energies;
  between.gravity_work = 20.0; // and 100 J at first
  checks.put_in(between);
  EXPECT_FALSE(checks.look_at_energy(moment, 0.0));
  for (std::size_t i = 0; i < energy_window; ++i)
    EXPECT_FALSE(checks.look_at_energy(moment, -11.9)) << i;
  EXPECT_TRUE(checks.look_at_energy(moment, -15.0));
}

/// A side that stops a body within the first step takes energy in that step, not before the run.
TEST(StressChecks, CountLossesFromNothing) {
  StressChecks checks(stress_limits(block()));
  StressMoment moment = calm();
  EXPECT_FALSE(checks.look(moment));
  for (std::size_t i = 0; i < 2 * energy_window; ++i)
    EXPECT_FALSE(checks.look_at_energy(moment, i == 0 ? 50.0 : 30.0)) << i;
}

TEST(StressChecks, FindEnergyMadeAfterRest) {
  StressChecks checks(stress_limits(block()));
  StressMoment moment = calm();
  moment.energies.grid_kinetic = 100.0;
  EXPECT_FALSE(checks.look(moment));
  EXPECT_FALSE(checks.look_at_energy(moment, 0.0));
  moment.energies.grid_kinetic = 0.01;
  for (std::size_t i = 0; i < 3 * energy_window; ++i)
    EXPECT_FALSE(checks.look_at_energy(moment, 50.0));
  std::string found;
  for (std::size_t i = 0; i < energy_window; ++i)
    if (const auto failure = checks.look_at_energy(moment, 48.9)) // 1.1 J of 100 J
      found = failure->check;
  EXPECT_EQ(found, "rest");
}

TEST(StressChecks, ExplainWhoMayLeave) {
  Scene scene = block();
  scene.grid.walls[2][0].kind = WallKind::fixed;
  const auto verdict = [&](std::array<double, 3> position, double speed) {
    StressMoment last = calm();
    last.velocity = {speed, 0.0, 0.0};
    const auto failure = explain(RunError("gone", 1, 0.5, 0, position), scene, last);
    return failure ? failure->check : std::string();
  };
  EXPECT_EQ(verdict({7.9, 0.0, 2.0}, 5.0), "") << "at the free side";
  EXPECT_EQ(verdict({7.9, 0.0, 2.0}, 50.0), "leaving") << "thrown";
  EXPECT_EQ(verdict({4.0, 0.0, 0.1}, 5.0), "leaving") << "through the base";
  EXPECT_EQ(verdict({4.0, 0.0, 2.0}, 5.0), "leaving") << "in the middle: a negative volume";
}

TEST(StressScenes, DependOnSeedAndNumberOnly) {
  const std::string scene = io::scene_to_toml(stress_scene(Preset::accurate, 7, 12).scene);
  stress_scene(Preset::accurate, 7, 11);
  EXPECT_EQ(io::scene_to_toml(stress_scene(Preset::accurate, 7, 12).scene), scene);
  EXPECT_NE(io::scene_to_toml(stress_scene(Preset::accurate, 8, 12).scene), scene);
  EXPECT_NE(
      io::scene_to_toml(stress_scene(Preset::accurate, 7, 12 + stress_families().size()).scene),
      scene);
}

/// `scarp run` has to take what a failure leaves.
TEST(StressScenes, AreSceneFilesOfModestSize) {
  const std::filesystem::path file = test::fresh_directory() / "scene.toml";
  std::set<std::string> families;
  std::set<int> dimensions;
  for (std::size_t k = 0; k < 140; ++k) {
    const StressScene stress = stress_scene(Preset::accurate, 1, k);
    families.insert(stress.family);
    dimensions.insert(stress.scene.grid.dimension);
    const std::string text = io::scene_to_toml(stress.scene);
    EXPECT_EQ(io::scene_to_toml(io::read_scene(test::write_file(file, text))), text)
        << "scene " << k;
    EXPECT_LE(make_simulation(stress.scene)->points(), 800U) << "scene " << k;
  }
  EXPECT_EQ(families.size(), stress_families().size());
  EXPECT_EQ(dimensions, (std::set<int>{2, 3}));
}

TEST(StressRun, IsTheSameForAnyNumberOfJobs) {
  const auto one = run_stress_scenes(Preset::accurate, 3, 28, 1, [](const StressResult&) {});
  std::size_t calls = 0;
  const auto three =
      run_stress_scenes(Preset::accurate, 3, 28, 3, [&](const StressResult&) { ++calls; });
  EXPECT_EQ(calls, 28U);
  for (std::size_t k = 0; k < 28; ++k) {
    EXPECT_EQ(three[k].number, k);
    EXPECT_EQ(three[k].steps, one[k].steps);
    EXPECT_EQ(three[k].end, one[k].end);
    EXPECT_EQ(three[k].nearest, one[k].nearest);
  }
}

/// Scenes that failed once and were cured at a cause (README, what keeps it stable): bodies on
/// friction walls, films on fixed ones that crept, points that dilated as they opened; and cut
/// squares between a wall and a body, for which the bound is another (apps/stress_checks.hpp, cut).
TEST(StressRun, CuredScenesStayCured) {
  std::size_t scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(SCARP_SOURCE_DIR "/tests/unit/stress_scenes")) {
    const StressResult result = run_stress_scene({scenes++, "cured", io::read_scene(entry.path())});
    EXPECT_TRUE(result.end == StressEnd::finished || result.end == StressEnd::left_grid)
        << entry.path() << ": " << result.message << ' '
        << (result.failure ? result.failure->check : "");
  }
  EXPECT_GE(scenes, 137U);
}

TEST(StressRun, TellsOfRefusedScenes) {
  StressScene stress{0, "block", block()};
  stress.scene.regions[0].material = "none";
  const StressResult result = run_stress_scene(stress);
  EXPECT_EQ(result.end, StressEnd::refused);
  EXPECT_NE(result.message.find("no material 'none'"), std::string::npos);
}

} // namespace
} // namespace scarp::apps
