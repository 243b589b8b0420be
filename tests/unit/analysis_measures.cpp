#include "core/analysis/measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace scarp::analysis;

namespace {

constexpr double step = 1.0 / 64.0; // exact in binary, so are its multiples

/// A slide from 0 to 15 s whose measures are known.  The monitors' velocities are parabolas, which
/// smoothing leaves as they are; the kinetic energy rises to 8 J at 6 s and falls to 0 at 10 s,
/// `bump` J come once more from 12 to 13 s.
SlideRecord slide(double bump = 0.0) {
  SlideRecord record;
  record.monitor_velocity.resize(2);
  for (int i = 0; i <= 15 * 64; ++i) {
    const double t = step * i;
    record.time.push_back(t);
    record.monitor_velocity[0].push_back(5.0 - 0.25 * (t - 7.0) * (t - 7.0));
    record.monitor_velocity[1].push_back(1.5 - 0.125 * (t - 8.0) * (t - 8.0));
    record.kinetic_energy.push_back(t < 6.0                 ? 8.0 * t / 6.0
                                    : t < 10.0              ? 2.0 * (10.0 - t)
                                    : t >= 12.0 && t < 13.0 ? bump
                                                            : 0.0);
    record.front.push_back(std::min(70.0 + t, 87.0 - 3.0));
  }
  return record;
}

} // namespace

TEST(Measures, OfASlideThatIsKnown) {
  const SlideMeasures measures = measure(
      slide(), {.rest_fraction = 0.0625, .loading_start = 3.0, .toe = 70.0, .thickness = 0.5});
  ASSERT_EQ(measures.monitors.size(), 2U);
  EXPECT_NEAR(measures.monitors[0].velocity.value, 5.0, 1e-12);
  EXPECT_EQ(measures.monitors[0].velocity.time, 7.0);
  EXPECT_NEAR(measures.monitors[0].acceleration.value, 2.0, 1e-12) << "at 0 s it is 3.5";
  EXPECT_EQ(measures.monitors[0].acceleration.time, 3.0);
  EXPECT_NEAR(measures.monitors[1].velocity.value, 1.5, 1e-12);
  EXPECT_EQ(measures.monitors[1].velocity.time, 8.0);
  EXPECT_NEAR(measures.monitors[1].acceleration.value, 1.25, 1e-12);
  EXPECT_EQ(measures.kinetic_energy.value, 4.0);
  EXPECT_EQ(measures.kinetic_energy.time, 6.0);
  EXPECT_EQ(measures.run_out, 14.0);
  // 2 (10 - t) is 0.0625 * 8 at 9.75 s, and less a sample later.
  EXPECT_EQ(measures.rest, 9.75 + step);
  EXPECT_EQ(measures.first_rest, 9.75 + step + 0.5);
  ASSERT_TRUE(measures.after_rest_fraction);
  EXPECT_LT(*measures.after_rest_fraction, 0.0625);
}

/// The velocity is smoothed: noise makes no peak.
TEST(Measures, SmoothesVelocitiesOnly) {
  SlideRecord record = slide();
  record.monitor_velocity[0][64] += 7.0; // at 1 s: one point's jump
  record.kinetic_energy[64] += 7.0;
  const SlideMeasures measures = measure(record, {.smoothing_width = 2.0, .loading_start = 3.0});
  EXPECT_EQ(measures.monitors[0].velocity.time, 7.0);
  EXPECT_EQ(measures.kinetic_energy.time, 1.0);
}

TEST(Measures, GainOfEnergyAfterRest) {
  const SlideMeasures small = measure(slide(0.004), {});
  EXPECT_LE(*small.after_rest_fraction, 1e-3);
  EXPECT_LT(*small.rest, 12.0) << "0.0005 of the peak is rest";
  const SlideMeasures large = measure(slide(0.08), {});
  EXPECT_EQ(large.first_rest, small.first_rest);
  EXPECT_NEAR(*large.after_rest_fraction, 0.01, 1e-15);
  EXPECT_EQ(large.rest, 13.0);
}

/// The points' energy that the grid does not see is no motion.
TEST(Measures, RestIsJudgedOnItsOwnEnergy) {
  SlideRecord record = slide();
  record.rest_energy = record.kinetic_energy;
  const SlideMeasures before = measure(record, {});
  for (double& energy : record.kinetic_energy) energy += 1.0;
  const SlideMeasures measures = measure(record, {});
  EXPECT_EQ(measures.kinetic_energy.value, 9.0);
  EXPECT_EQ(measures.rest, before.rest);
  EXPECT_EQ(measures.after_rest_fraction, before.after_rest_fraction);
  record.rest_energy.pop_back();
  EXPECT_THROW(measure(record, {}), std::invalid_argument);
}

TEST(Measures, NeverAtRest) {
  SlideRecord record = slide();
  record.kinetic_energy.back() = 1.0;
  EXPECT_FALSE(measure(record, {}).rest);
  EXPECT_TRUE(measure(record, {}).first_rest);
  EXPECT_FALSE(measure(record, {.rest_duration = 6.0}).first_rest);
  EXPECT_FALSE(measure(record, {.rest_duration = 6.0}).after_rest_fraction);
  std::ranges::fill(record.kinetic_energy, 0.0);
  EXPECT_FALSE(measure(record, {}).rest) << "nothing has moved, so nothing comes to rest";
}

TEST(Measures, Errors) {
  EXPECT_THROW(measure({}, {}), std::invalid_argument);
  EXPECT_THROW(measure(slide(), {.loading_start = 15.1}), std::invalid_argument);
  EXPECT_NO_THROW(measure(slide(), {.loading_start = 15.0}));
  EXPECT_THROW(measure(slide(), {.smoothing_width = 0.0}), std::invalid_argument);
  SlideRecord record = slide();
  record.front.pop_back();
  EXPECT_THROW(measure(record, {}), std::invalid_argument);
  record = slide();
  record.kinetic_energy[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(measure(record, {}), std::invalid_argument);
  record = slide();
  record.monitor_velocity[1].push_back(0.0);
  EXPECT_THROW(measure(record, {}), std::invalid_argument);
}
