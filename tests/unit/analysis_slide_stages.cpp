#include "core/analysis/slide_stages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace scarp::analysis;

namespace {

/// Steps of tanh: `rise` m/s at `when`, each within about 2 x `within` s.
struct Step {
  double rise, when, within;
};

Smoothed toe_of(const std::vector<double>& time, const std::vector<Step>& steps) {
  Smoothed toe;
  for (const double t : time) {
    double v = 0.0, a = 0.0;
    for (const Step& step : steps) {
      const double y = std::tanh((t - step.when) / step.within);
      v += 0.5 * step.rise * (1.0 + y);
      a += 0.5 * step.rise / step.within * (1.0 - y * y);
    }
    toe.value.push_back(v);
    toe.rate.push_back(a);
  }
  return toe;
}

std::vector<double> times() {
  std::vector<double> time;
  for (int i = 0; i <= 1200; ++i) time.push_back(3.0 + 0.01 * i);
  return time;
}

} // namespace

/// A creep of 0.5 m/s between two rises: nine tenths of it are reached where tanh is 0.8, eleven
/// tenths where the second rise of 1.5 m/s has given a thirtieth, tanh = -14/15.
TEST(SlideStages, CreepBetweenTwoRises) {
  const std::vector<double> time = times();
  const Smoothed toe = toe_of(time, {{0.5, 3.3, 0.1}, {1.5, 5.0, 0.3}, {-2.0, 8.0, 0.4}});
  const auto stages = find_stages(time, toe, 3.0, 6.5, 10.0);
  ASSERT_TRUE(stages);
  EXPECT_EQ(stages->compression, 3.0);
  EXPECT_NEAR(stages->creep_velocity, 0.5, 0.005);
  EXPECT_NEAR(stages->creep, 3.3 + 0.1 * std::atanh(0.8), 0.011);
  EXPECT_NEAR(stages->acceleration, 5.0 - 0.3 * std::atanh(14.0 / 15.0), 0.03);
  EXPECT_EQ(stages->deceleration, 6.5);
  EXPECT_EQ(stages->rest, 10.0);
}

TEST(SlideStages, NoneWithoutACreep) {
  const std::vector<double> time = times();
  EXPECT_FALSE(
      find_stages(time, toe_of(time, {{2.0, 5.0, 1.0}, {-2.0, 8.0, 0.4}}), 3.0, 6.5, 10.0));
  EXPECT_FALSE(find_stages(time, toe_of(time, {}), 3.0, 6.5, 10.0)) << "nothing moves";
}

TEST(SlideStages, RefusesWhatDoesNotGoTogether) {
  const std::vector<double> time = times();
  const Smoothed toe = toe_of(time, {{0.5, 3.3, 0.1}});
  EXPECT_THROW(find_stages({3.0}, toe, 3.0, 6.5, 10.0), std::invalid_argument);
  EXPECT_THROW(find_stages(time, toe, 7.0, 6.5, 10.0), std::invalid_argument);
  EXPECT_THROW(find_stages(time, toe, 3.0, 6.5, 6.0), std::invalid_argument);
}
