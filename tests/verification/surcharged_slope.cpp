// The base case of Wu et al. 2017 (data/scenes/wu2017.toml: 10 975 points, 15 s) against the values
// that the paper reports, with the tolerances that shared figures of two codes deserve.
#include "core/analysis/measures.hpp"
#include "core/analysis/slide_stages.hpp"
#include "core/run.hpp"
#include "io/scene_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

using namespace scarp;

namespace {

struct Record : Observer {
  analysis::SlideRecord slide;
  std::vector<std::size_t> monitors;
  std::vector<double> scheme_loss, gravity_work;

  void history(const Simulation& simulation, const Energies& energies) override {
    slide.time.push_back(simulation.time());
    slide.kinetic_energy.push_back(energies.kinetic);
    slide.rest_energy.push_back(energies.grid_kinetic);
    slide.front.push_back(simulation.front());
    const std::vector<double> v = simulation.field("velocity");
    for (std::size_t m = 0; m < monitors.size(); ++m)
      slide.monitor_velocity[m].push_back(v[3 * monitors[m]]);
    scheme_loss.push_back(energies.scheme_loss);
    gravity_work.push_back(energies.gravity_work);
  }
};

} // namespace

TEST(SurchargedSlope, SlidesAsInWu2017) {
  const Scene scene =
      io::read_scene(std::filesystem::path(SCARP_SOURCE_DIR) / "data/scenes/wu2017.toml");
  const auto simulation = make_simulation(scene);
  EXPECT_EQ(simulation->points(), 10975U);
  Record record;
  for (const Monitor& monitor : scene.monitors)
    record.monitors.push_back(simulation->nearest_point(monitor.position));
  record.slide.monitor_velocity.resize(record.monitors.size());
  run(*simulation, scene.timing, record);

  const analysis::MeasureOptions options{.smoothing_width = 1.2,
                                         .rest_fraction = 0.01,
                                         .rest_duration = 0.5,
                                         .loading_start = 3.0,
                                         .toe = 70.0,
                                         .thickness = 0.5};
  const analysis::SlideMeasures measures = analysis::measure(record.slide, options);
  EXPECT_NEAR(measures.kinetic_energy.value, 3596e3, 0.02 * 3596e3);
  EXPECT_NEAR(measures.monitors[0].velocity.value, 5.0, 0.6);
  EXPECT_NEAR(measures.monitors[1].velocity.value, 5.8, 0.3);
  EXPECT_NEAR(measures.monitors[2].velocity.value, 1.86, 0.3);
  EXPECT_NEAR(measures.run_out, 17.0, 1.0);
  ASSERT_TRUE(measures.rest);
  EXPECT_NEAR(*measures.rest, 10.0, 1.0);
  EXPECT_LT(*measures.after_rest_fraction, options.rest_fraction) << "no energy after rest";

  const auto& time = record.slide.time;
  const analysis::Smoothed toe =
      analysis::smooth({time, record.slide.monitor_velocity[2]}, options.smoothing_width);
  const auto stages =
      analysis::find_stages(time, toe, 3.0, measures.kinetic_energy.time, *measures.rest);
  ASSERT_TRUE(stages);
  EXPECT_NEAR(stages->creep_velocity, 0.45, 0.1);
  EXPECT_NEAR(stages->acceleration, 4.0, 0.3);
  EXPECT_GT(stages->deceleration, 6.0);
  EXPECT_LT(stages->deceleration, 7.0);

  // Nothing but gravity gives energy (measured: the scheme takes 0.5 % of its work; in the elastic
  // stage at most 1e-4 of that).
  for (std::size_t i = 0; i < time.size(); ++i)
    EXPECT_GT(record.scheme_loss[i], -1e-3 * record.gravity_work.back()) << "at " << time[i];
  EXPECT_LT(record.scheme_loss.back(), 0.02 * record.gravity_work.back());
}
