#include "core/analysis/signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>

using namespace scarp::analysis;

namespace {

constexpr double pi = 3.14159265358979323846;

Signal sampled(std::vector<double> time, double (*function)(double)) {
  Signal signal{.time = std::move(time), .value = {}};
  for (const double t : signal.time) signal.value.push_back(function(t));
  return signal;
}

} // namespace

/// Also in the cut windows at the ends; each holds three samples at least.
TEST(Smooth, IsExactOnParabolasAtUnevenTimes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(0.01, 0.1);
  std::vector<double> time{3.0};
  while (time.back() < 15.0) time.push_back(time.back() + step(random));
  const Signal signal = sampled(time, [](double t) { return 2.0 - 3.0 * t + 0.5 * t * t; });
  for (const double width : {0.4, 1.0, 3.0, 100.0}) {
    const Smoothed smoothed = smooth(signal, width);
    ASSERT_EQ(smoothed.value.size(), time.size());
    ASSERT_EQ(smoothed.rate.size(), time.size());
    for (std::size_t i = 0; i < time.size(); ++i) {
      EXPECT_NEAR(smoothed.value[i], signal.value[i], 1e-11) << width << " s at " << time[i];
      EXPECT_NEAR(smoothed.rate[i], time[i] - 3.0, 1e-11) << width << " s at " << time[i];
    }
  }
}

/// In 2 m + 1 even samples the parabola's value at the middle has the weights
/// c_j = (3 (3 m^2 + 3 m - 1) - 15 j^2) / ((2m - 1)(2m + 1)(2m + 3)), its slope j / (dt sum j^2)
/// (the normal equations by hand; Savitzky & Golay 1964, tables I and III).  A sine is therefore
/// multiplied by sum c_j cos(j w dt), its derivative is sum j sin(j w dt) / (dt sum j^2) cos(w t).
TEST(Smooth, DampsASineByTheGainOfItsWindow) {
  constexpr double dt = 0.01, width = 0.2;
  constexpr int m = 10, samples = 301;
  for (const double frequency : {0.5, 2.0, 5.0, 8.0, 20.0, 40.0}) {
    const double phase = 2.0 * pi * frequency * dt;
    double gain = 0.0, rate_gain = 0.0, sum_jj = 0.0;
    for (int j = -m; j <= m; ++j) {
      const double weight = (3.0 * (3.0 * m * m + 3.0 * m - 1.0) - 15.0 * j * j) /
                            ((2.0 * m - 1.0) * (2.0 * m + 1.0) * (2.0 * m + 3.0));
      gain += weight * std::cos(j * phase);
      rate_gain += j * std::sin(j * phase) / dt;
      sum_jj += j * j;
    }
    rate_gain /= sum_jj;
    Signal signal;
    for (int i = 0; i < samples; ++i) {
      signal.time.push_back(dt * i);
      signal.value.push_back(std::sin(phase * i));
    }
    const Smoothed smoothed = smooth(signal, width);
    for (int i = m; i < samples - m; ++i) {
      const auto sample = static_cast<std::size_t>(i);
      EXPECT_NEAR(smoothed.value[sample], gain * std::sin(phase * i), 1e-13) << frequency << " Hz";
      EXPECT_NEAR(smoothed.rate[sample], rate_gain * std::cos(phase * i), 1e-11)
          << frequency << " Hz";
    }
    if (frequency <= 0.5) {
      EXPECT_NEAR(gain, 1.0, 0.001) << "slow motion passes";
    }
    if (frequency >= 8.0) {
      EXPECT_LT(std::abs(gain), 0.3) << "fast motion does not";
    }
  }
}

TEST(Smooth, FewSamplesInTheWindow) {
  const Signal signal{.time = {0.0, 1.0, 1.5, 4.0}, .value = {1.0, 7.0, 8.0, -2.0}};
  const Smoothed smoothed = smooth(signal, 1.0);
  EXPECT_EQ(smoothed.value, signal.value);
  EXPECT_EQ(smoothed.rate, (std::vector<double>{0.0, 2.0, 2.0, 0.0}));
  EXPECT_TRUE(smooth({}, 1.0).value.empty());
}

/// Times that differ by rounding only make no parabola.
TEST(Smooth, NearlyEqualTimesInTheWindow) {
  const double twin = std::nextafter(1.0, 2.0);
  const Smoothed smoothed = smooth({.time = {0.0, 1.0, twin}, .value = {0.0, 1.9, 2.1}}, 4.0);
  for (const std::size_t i : {1U, 2U}) EXPECT_NEAR(smoothed.value[i], 2.0, 1e-12);
  for (const double rate : smoothed.rate) EXPECT_NEAR(rate, 2.0, 1e-12);
}

TEST(Smooth, Errors) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(smooth({.time = {0.0, 1.0}, .value = {0.0}}, 1.0), std::invalid_argument);
  EXPECT_THROW(smooth({.time = {0.0, 0.0}, .value = {0.0, 1.0}}, 1.0), std::invalid_argument);
  EXPECT_THROW(smooth({.time = {1.0, 0.0}, .value = {0.0, 1.0}}, 1.0), std::invalid_argument);
  EXPECT_THROW(smooth({.time = {0.0, nan}, .value = {0.0, 1.0}}, 1.0), std::invalid_argument);
  EXPECT_THROW(smooth({.time = {0.0, 1.0}, .value = {0.0, nan}}, 1.0), std::invalid_argument);
  const Signal good{.time = {0.0, 1.0}, .value = {0.0, 1.0}};
  for (const double width : {0.0, -1.0, nan})
    EXPECT_THROW(smooth(good, width), std::invalid_argument);
}
