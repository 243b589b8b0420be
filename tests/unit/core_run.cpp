#include "core/run.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

using namespace scarp;
using namespace scarp::test;

namespace {

struct Record : Observer {
  std::vector<double> frames, rows, grid_kinetic;
  long steps = 0;
  void frame(const Simulation& simulation) override { frames.push_back(simulation.time()); }
  void history(const Simulation& simulation, const Energies& energies) override {
    rows.push_back(simulation.time());
    grid_kinetic.push_back(energies.grid_kinetic);
  }
  void progress(const Simulation&) override { ++steps; }
};

} // namespace

/// Frames at every multiple of the interval, computed as such (not summed up), and at the end.
TEST(Run, FramesAtMultiplesOfTheInterval) {
  Scene scene = small_pile();
  scene.timing.end_time = 0.025;
  scene.timing.output_interval = 0.01;
  Record record;
  const auto simulation = make_simulation(scene);
  const RunSummary summary = run(*simulation, scene.timing, record);
  EXPECT_EQ(record.frames, (std::vector<double>{0.0, 0.01, 0.02, 0.025}));
  EXPECT_EQ(summary.reason, StopReason::end_time);
  EXPECT_EQ(summary.stop_time, 0.025);
  EXPECT_EQ(record.steps, simulation->steps());
  EXPECT_GT(summary.peak_kinetic, 0.0);
  EXPECT_LE(summary.shortest_step, summary.longest_step);
  EXPECT_GT(summary.shortest_step, 0.9 * summary.longest_step)
      << "without the steps cut for frames";
}

/// 0.001 added up ten times is not 0.01 in binary; ten times 0.001 is.
TEST(Run, FrameTimesDoNotDrift) {
  Scene scene = small_pile();
  scene.timing.end_time = 0.01;
  scene.timing.output_interval = 0.001;
  Record record;
  run(*make_simulation(scene), scene.timing, record);
  ASSERT_EQ(record.frames.size(), 11U);
  double added_up = 0.0;
  for (std::size_t frame = 0; frame < 11; ++frame) {
    EXPECT_EQ(record.frames[frame], 0.001 * static_cast<double>(frame));
    if (frame > 0) added_up += 0.001;
  }
  EXPECT_NE(added_up, 0.01) << "or this test shows nothing";
}

/// A row at the first step at or after each multiple of history_interval.
TEST(Run, HistoryRows) {
  Scene scene = small_pile();
  scene.timing.end_time = 0.01;
  scene.timing.output_interval = 0.01;
  Record record;
  const auto simulation = make_simulation(scene);
  const double dt = simulation->stable_time_step();
  run(*simulation, scene.timing, record);
  ASSERT_EQ(record.rows.size(), 11U) << "by default a tenth of the output interval";
  for (std::size_t row = 0; row < record.rows.size(); ++row) {
    EXPECT_GE(record.rows[row], 0.001 * static_cast<double>(row));
    EXPECT_LT(record.rows[row], 0.001 * static_cast<double>(row) + dt);
  }
  scene.timing.history_interval = 0.005;
  Record coarse;
  run(*make_simulation(scene), scene.timing, coarse);
  EXPECT_EQ(coarse.rows.size(), 3U);
}

/// The pile comes to rest long before the end; then a last frame, and out.
TEST(Run, EndsAtRest) {
  Scene scene = small_pile();
  scene.method.local_damping = 0.3;
  scene.timing.end_time = 5.0;
  scene.timing.output_interval = 0.1;
  scene.timing.rest_energy_fraction = 1e-3;
  scene.timing.rest_duration = 0.03;
  Record record;
  const RunSummary summary = run(*make_simulation(scene), scene.timing, record);
  EXPECT_EQ(summary.reason, StopReason::at_rest);
  EXPECT_LT(summary.stop_time, 2.0);
  EXPECT_EQ(record.frames.back(), summary.stop_time);
  const double peak = *std::max_element(record.grid_kinetic.begin(), record.grid_kinetic.end());
  for (std::size_t row = 0; row < record.rows.size(); ++row)
    if (record.rows[row] >= summary.stop_time - 0.03) {
      EXPECT_LE(record.grid_kinetic[row], 1e-3 * peak) << record.rows[row];
    }
}

TEST(Run, WritesAFrameWhenItFails) {
  Scene scene = small_pile();
  scene.grid.upper[0] = 0.05; // 10 mm of room for the front
  scene.timing.end_time = 1.0;
  scene.timing.output_interval = 1.0;
  Record record;
  const auto simulation = make_simulation(scene);
  EXPECT_THROW(run(*simulation, scene.timing, record), RunError);
  ASSERT_EQ(record.frames.size(), 2U);
  EXPECT_EQ(record.frames[1], simulation->time());
  EXPECT_LT(simulation->front(), 0.05);
  EXPECT_GT(simulation->time(), 0.01);
}

namespace {
struct Refusing : Observer {
  void frame(const Simulation&) override { throw std::runtime_error("disk full"); }
};
} // namespace

TEST(Run, PassesOnWhatTheObserverThrows) {
  Scene scene = small_pile();
  scene.timing.end_time = scene.timing.output_interval = 0.01;
  Refusing observer;
  const auto simulation = make_simulation(scene);
  EXPECT_THROW(run(*simulation, scene.timing, observer), std::runtime_error);
}
