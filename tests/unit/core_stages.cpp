#include "core/error.hpp"
#include "core/run.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr double g = 10.0;

Stage stage(const std::string& name, double duration) {
  Stage made;
  made.name = name;
  made.duration = duration;
  return made;
}

/// Two blocks that fall freely, too far apart to feel each other.
Scene two_blocks() {
  Scene scene;
  scene.grid = grid_2d(0.1, {0.0, 0.0}, {2.0, 4.0});
  scene.gravity = {0.0, 0.0, -g};
  scene.materials = {elastic("foam", 100.0, 1e5, 0.2)};
  scene.regions = {box("light", "foam", {0.2, 3.0}, {0.6, 3.4}),
                   box("heavy", "foam", {1.2, 3.0}, {1.6, 3.4})};
  scene.timing.max_time_step = 1e-4;
  return scene;
}

/// A soil block on a base between smooth walls, elastic at first.
Scene pressed_block() {
  Scene scene = pile(0.2, 0.2, 0.05, 0.2, 0.4);
  scene.grid.walls[0][1].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::symmetry;
  Material foam = elastic("foam", 2650.0, 0.84e6, 0.3);
  scene.materials.push_back(foam);
  scene.stages = {stage("elastic", 0.05), stage("plastic", 0.05)};
  scene.stages[0].material = {{"pile", "foam"}};
  return scene;
}

double vertical_velocity(const Simulation& simulation, std::array<double, 3> place) {
  return simulation.field("velocity")[3 * simulation.nearest_point(place) + 2];
}

Snapshot snapshot(const Simulation& simulation) {
  return {.time = simulation.time(),
          .steps = simulation.steps(),
          .position = simulation.positions(),
          .displacement = simulation.field("displacement"),
          .velocity = simulation.field("velocity"),
          .stress = simulation.field("stress"),
          .volume = simulation.field("volume"),
          .initial_volume = simulation.field("initial_volume"),
          .plastic_strain = simulation.field("equivalent_plastic_strain"),
          .gap = simulation.field("gap"),
          .velocity_gradient = simulation.field("velocity_gradient")};
}

struct Frames : Observer {
  std::vector<double> times;
  void frame(const Simulation& simulation) override { times.push_back(simulation.time()); }
};

} // namespace

TEST(Ramp, IsLinearBetweenItsPointsAndConstantOutside) {
  const Ramp ramp = {{{1.0, 0.0}, {3.0, 4.0}, {4.0, 2.0}}};
  EXPECT_EQ(ramp.at(0.0), 0.0);
  EXPECT_EQ(ramp.at(1.0), 0.0);
  EXPECT_EQ(ramp.at(1.5), 1.0);
  EXPECT_EQ(ramp.at(3.0), 4.0);
  EXPECT_EQ(ramp.at(3.75), 2.5);
  EXPECT_EQ(ramp.at(9.0), 2.0);
  EXPECT_EQ(Ramp{}.at(5.0), 1.0);
}

/// v = - int f(t) g dt: with f from 0 to 1 in T, - g T/2; the heavy block three times that.  Forces
/// are those at a step's beginning, so what is missing is of the order of one step.
TEST(Stages, RampsAndRegionsMultiplyGravity) {
  Scene scene = two_blocks();
  scene.stages = {stage("ramp", 0.2), stage("full", 0.1)};
  scene.stages[0].gravity = {{{0.0, 0.0}, {0.2, 1.0}}};
  scene.stages[0].body_force = {{"heavy", {{{0.0, 3.0}}}}};
  const auto simulation = make_simulation(scene);
  const double step_error = 1e-4 * g;
  run_until(*simulation, 0.2);
  EXPECT_NEAR(vertical_velocity(*simulation, {0.4, 0, 3.2}), -1.0, step_error);
  EXPECT_NEAR(vertical_velocity(*simulation, {1.4, 0, 3.2}), -3.0, 3 * step_error);

  simulation->next_stage();
  run_until(*simulation, 0.3);
  EXPECT_NEAR(vertical_velocity(*simulation, {0.4, 0, 3.2}), -2.0, 2 * step_error);
  EXPECT_NEAR(vertical_velocity(*simulation, {1.4, 0, 3.2}), -4.0, 4 * step_error);

  const Energies now = simulation->energies();
  const double mass = 100.0 * 0.4 * 0.4;
  EXPECT_NEAR(now.kinetic, 0.5 * mass * (4.0 + 16.0), 0.01 * now.kinetic);
  EXPECT_NEAR(now.gravity_work, now.kinetic, 2e-3 * now.kinetic)
      << "the work of forces that change is added up step by step";
}

/// A force that changes at a stage's start keeps the work done before.
TEST(Stages, WorkGoesOverFromStageToStage) {
  Scene scene = two_blocks();
  scene.stages = {stage("fall", 0.1), stage("float", 0.1)};
  scene.stages[1].gravity = {{{0.0, 0.0}}};
  const auto simulation = make_simulation(scene);
  run_until(*simulation, 0.1);
  const double work = simulation->energies().gravity_work;
  simulation->next_stage();
  run_until(*simulation, 0.2);
  EXPECT_GT(work, 0.0);
  EXPECT_EQ(simulation->energies().gravity_work, work);
  EXPECT_NEAR(vertical_velocity(*simulation, {0.4, 0, 3.2}), -1.0, 1e-2);
}

TEST(Stages, StressGoesOverWhenTheLawChanges) {
  const Scene scene = pressed_block();
  const auto simulation = make_simulation(scene);
  EXPECT_EQ(simulation->stage().name, "elastic");
  run_until(*simulation, simulation->stage_end());
  const std::vector<double> before = simulation->field("stress");
  for (const double strain : simulation->field("equivalent_plastic_strain")) EXPECT_EQ(strain, 0.0);
  simulation->next_stage();
  EXPECT_EQ(simulation->stage().name, "plastic");
  EXPECT_EQ(simulation->field("stress"), before);
  EXPECT_TRUE(simulation->in_last_stage());
  run_until(*simulation, simulation->stage_end());
  double most = 0.0;
  for (const double strain : simulation->field("equivalent_plastic_strain"))
    most = std::max(most, strain);
  EXPECT_GT(most, 0.0) << "K0 = nu/(1 - nu) lies outside a cone of 19.8 degrees";
  EXPECT_THROW(simulation->next_stage(), std::logic_error);
}

/// Steps end with the stage, so that no force or law acts early.
TEST(Stages, AStepDoesNotGoBeyondItsStage) {
  const auto simulation = make_simulation(pressed_block());
  while (simulation->time() < 0.05) simulation->step(1.0);
  EXPECT_EQ(simulation->time(), 0.05);
  EXPECT_THROW(simulation->step(1.0), std::invalid_argument);
}

TEST(Stages, ContinuesFromAnotherRunAsIfItHadRunThrough) {
  Scene scene = pressed_block();
  const auto whole = make_simulation(scene);
  run_until(*whole, 0.05);
  const Snapshot start = snapshot(*whole);
  scene.stages[1].begin_from = "elsewhere";
  const auto continued = make_simulation(scene, &start);
  EXPECT_EQ(continued->time(), 0.05);
  EXPECT_EQ(continued->steps(), whole->steps());
  EXPECT_EQ(continued->stage().name, "plastic");
  EXPECT_EQ(continued->field("displacement"), whole->field("displacement"));
  EXPECT_EQ(continued->energies().plastic, 0.0) << "energies count from the run's beginning";

  whole->next_stage();
  run_until(*whole, 0.07);
  run_until(*continued, 0.07);
  EXPECT_EQ(continued->steps(), whole->steps());
  const std::vector<double> expected = whole->positions();
  const std::vector<double> found = continued->positions();
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
  EXPECT_NEAR(continued->energies().plastic, whole->energies().plastic,
              1e-9 * whole->energies().plastic);
}

/// At a control point's distance a point is faster by h/2 |C|, and steps follow the fastest.
TEST(Stages, TheFirstStepKnowsTheGradientsThatARunBeginsWith) {
  Scene scene = pressed_block();
  scene.method = method_of(Preset::accurate);
  const auto whole = make_simulation(scene);
  run_until(*whole, 0.05);
  scene.stages[1].begin_from = "elsewhere";
  Snapshot still = snapshot(*whole);
  std::ranges::fill(still.velocity, 0.0);
  std::ranges::fill(still.velocity_gradient, 0.0);
  Snapshot moving = still, shearing = still;
  constexpr double speed = 3.0; // m/s
  for (std::size_t p = 0; p < still.gap.size(); ++p) {
    moving.velocity[3 * p] = speed;
    shearing.velocity_gradient[9 * p + 2] = speed / (0.5 * scene.grid.cell_size);
  }
  const auto first_step = [&](const Snapshot& start) {
    return make_simulation(scene, &start)->stable_time_step();
  };
  EXPECT_LT(first_step(moving), 0.9 * first_step(still));
  EXPECT_DOUBLE_EQ(first_step(shearing), first_step(moving));
}

TEST(Stages, RefuseAStateThatIsNotTheirs) {
  Scene scene = pressed_block();
  const auto whole = make_simulation(scene);
  Snapshot start = snapshot(*whole);
  EXPECT_THROW(make_simulation(scene, &start), SetupError) << "no stage asks for it";
  scene.stages[1].begin_from = "elsewhere";
  EXPECT_THROW(make_simulation(scene), SetupError) << "it is missing";
  EXPECT_NO_THROW(make_simulation(scene, &start));
  start.position[3 * 5] += 0.01;
  EXPECT_THROW(make_simulation(scene, &start), SetupError) << "point 5 began elsewhere";
  start = snapshot(*make_simulation(pile(0.2, 0.1, 0.05, 0.2, 0.4)));
  EXPECT_THROW(make_simulation(scene, &start), SetupError) << "fewer points";
}

TEST(Stages, RunGoesThroughThemWithAFrameAtEachEnd) {
  Scene scene = pressed_block();
  scene.timing.output_interval = 0.02;
  Frames frames;
  const auto simulation = make_simulation(scene);
  const RunSummary summary = run(*simulation, scene.timing, frames);
  EXPECT_EQ(frames.times, (std::vector<double>{0.0, 0.02, 0.04, 0.05, 0.06, 0.08, 0.1}));
  EXPECT_EQ(summary.stop_time, 0.1);
}

/// At rest the stage is over and the next one begins; the run goes on.
TEST(Stages, UntilRestEndsAStageEarly) {
  Scene scene = pressed_block();
  scene.method.local_damping = 0.8;
  scene.timing.output_interval = 0.5;
  scene.timing.history_interval = 1e-3;
  scene.timing.rest_energy_fraction = 1e-3;
  scene.timing.rest_duration = 0.01;
  scene.stages[0].duration = 5.0;
  scene.stages[0].until_rest = true;
  Frames frames;
  const auto simulation = make_simulation(scene);
  const RunSummary summary = run(*simulation, scene.timing, frames);
  ASSERT_EQ(frames.times.size(), 3U);
  EXPECT_LT(frames.times[1], 0.5);
  EXPECT_DOUBLE_EQ(frames.times[2], frames.times[1] + 0.05);
  EXPECT_EQ(summary.reason, StopReason::end_time);
}

TEST(Front, IsThatOfTheChosenRegions) {
  Scene scene = two_blocks();
  EXPECT_DOUBLE_EQ(make_simulation(scene)->front(), 1.575);
  scene.output.front_regions = {"light"};
  EXPECT_DOUBLE_EQ(make_simulation(scene)->front(), 0.575);
}
