#include "core/analysis/curve_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>

using namespace scarp::analysis;

namespace {

double exponential(const std::vector<double>& p, double t) {
  return p[0] + p[1] * std::exp(-t / p[2]);
}

double gaussian(const std::vector<double>& p, double t) {
  return p[0] + p[1] * std::exp(-(t - p[2]) * (t - p[2]) / (2.0 * p[3] * p[3]));
}

using Curve = double (*)(const std::vector<double>&, double);

/// Samples of a curve at even steps from `first`, with normal noise of the given deviation.
Signal sampled(Curve curve, const std::vector<double>& parameters, double first, double span,
               int samples, double noise = 0.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Signal signal;
  for (int i = 0; i < samples; ++i) {
    signal.time.push_back(first + span * i / (samples - 1));
    signal.value.push_back(curve(parameters, signal.time.back()) + noise * normal(random));
  }
  return signal;
}

void expect_recovered(const CurveFit& fit, const Signal& signal,
                      const std::vector<double>& parameters, double tolerance) {
  ASSERT_EQ(fit.values.size(), parameters.size());
  ASSERT_EQ(fit.names.size(), parameters.size());
  ASSERT_EQ(fit.standard_errors.size(), parameters.size());
  ASSERT_EQ(fit.residuals.size(), signal.time.size());
  for (std::size_t i = 0; i < parameters.size(); ++i)
    EXPECT_NEAR(fit.values[i], parameters[i], tolerance * std::abs(parameters[i])) << fit.names[i];
  for (const double error : fit.standard_errors) EXPECT_TRUE(std::isfinite(error));
  EXPECT_NEAR(fit.r2, 1.0, 1e-12);
  for (std::size_t i = 0; i < signal.time.size(); ++i) {
    EXPECT_NEAR(fit.residuals[i], 0.0, 1e-9);
    EXPECT_NEAR(fit.evaluate(signal.time[i]), signal.value[i], 1e-9);
  }
}

/// Over many seeds the errors of the parameters, by their standard errors, must have the deviation
/// 1 (of 200: +- 0.05) and hardly ever exceed 3 (0.3 % of a normal distribution do).
void expect_honest_errors(CurveFit (*fit_curve)(const Signal&), Curve curve,
                          const std::vector<double>& parameters, double first, double span,
                          double noise) {
  constexpr unsigned seeds = 200;
  std::vector<double> squares(parameters.size());
  std::vector<int> beyond(parameters.size());
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const CurveFit fit = fit_curve(sampled(curve, parameters, first, span, 200, noise, seed));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const double error = (fit.values[i] - parameters[i]) / fit.standard_errors[i];
      squares[i] += error * error / seeds;
      beyond[i] += std::abs(error) > 3.0 ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    EXPECT_NEAR(std::sqrt(squares[i]), 1.0, 0.2) << "parameter " << i;
    EXPECT_LE(beyond[i], 3) << "parameter " << i;
  }
}

} // namespace

/// Rising and falling, towards y0 and away from it, from steep to nearly straight, at any time.
TEST(CurveFit, RecoversAnExponential) {
  for (const double first : {-2.0, 0.0, 3.0, 1000.0})
    for (const double tau : {0.3, 1.5, 10.0, 40.0, -0.6, -3.0, -20.0})
      for (const double height : {5.0, -0.7}) {
        if (std::abs(first / tau) > 700.0) continue; // `a` is beyond the range of numbers
        SCOPED_TRACE(testing::Message() << first << " s, tau " << tau << " s, height " << height);
        const std::vector<double> parameters{0.4, height * std::exp(first / tau), tau};
        const Signal signal = sampled(exponential, parameters, first, 4.0, 100);
        expect_recovered(fit_exponential(signal), signal, parameters, 1e-6);
      }
  EXPECT_EQ(fit_exponential(sampled(exponential, {1.0, 2.0, 3.0}, 0.0, 4.0, 50)).names,
            (std::vector<std::string>{"y0", "a", "tau"}));
}

/// Whole peaks and dips, and parts of them (t0 near the end, at 8 s), which resemble each other.
TEST(CurveFit, RecoversAGaussian) {
  for (const double first : {0.0, 3.0, 1000.0})
    for (const double w : {0.12, 0.5, 1.3, 3.0, 4.0})
      for (const double t0 : {0.7, 4.0, 7.4, 8.5})
        for (const double a : {5.8, -0.01}) {
          SCOPED_TRACE(testing::Message()
                       << first << " s, t0 " << t0 << " s, w " << w << " s, a " << a);
          const std::vector<double> parameters{0.05, a, first + t0, w};
          const Signal signal = sampled(gaussian, parameters, first, 8.0, 200);
          expect_recovered(fit_gaussian(signal), signal, parameters, 1e-6);
        }
  EXPECT_EQ(fit_gaussian(sampled(gaussian, {0.0, 1.0, 1.0, 1.0}, 0.0, 4.0, 50)).names,
            (std::vector<std::string>{"y0", "a", "t0", "w"}));
}

TEST(CurveFit, StandardErrorsAreHonest) {
  // A's two branches, and C's whole course, as far as Wu et al. 2017 tell.
  expect_honest_errors(fit_exponential, exponential, {6.0, -6.0 * std::exp(3.0 / 1.2), 1.2}, 3.0,
                       3.0, 0.05);
  expect_honest_errors(fit_exponential, exponential, {-0.5, 5.5 * std::exp(6.0 / 1.5), 1.5}, 6.0,
                       4.0, 0.05);
  expect_honest_errors(fit_gaussian, gaussian, {0.1, 1.8, 6.2, 1.1}, 3.0, 9.0, 0.05);
}

/// About 15 % of the variance is noise; r2 must say so.
TEST(CurveFit, R2OfNoise) {
  const Signal signal = sampled(gaussian, {0.0, 1.0, 5.0, 1.0}, 0.0, 10.0, 2000, 0.15);
  double mean = 0.0, total = 0.0, rest = 0.0;
  const CurveFit fit = fit_gaussian(signal);
  for (const double v : signal.value) mean += v / 2000.0;
  for (const double v : signal.value) total += (v - mean) * (v - mean);
  for (const double residual : fit.residuals) rest += residual * residual;
  EXPECT_NEAR(std::sqrt(rest / 1996.0), 0.15, 0.01);
  EXPECT_NEAR(fit.r2, 1.0 - rest / total, 1e-12);
}

TEST(CurveFit, Errors) {
  const std::vector<double> decay{0.0, 1.0, 1.0}, bell{0.0, 1.0, 2.0, 1.0};
  EXPECT_THROW(fit_exponential({}), std::invalid_argument);
  EXPECT_THROW(fit_exponential(sampled(exponential, decay, 0.0, 4.0, 3)), std::invalid_argument);
  EXPECT_NO_THROW(fit_exponential(sampled(exponential, decay, 0.0, 4.0, 4)));
  EXPECT_THROW(fit_gaussian(sampled(gaussian, bell, 0.0, 4.0, 4)), std::invalid_argument);
  EXPECT_NO_THROW(fit_gaussian(sampled(gaussian, bell, 0.0, 4.0, 5)));
  EXPECT_THROW(fit_exponential({.time = {0.0, 1.0, 2.0, 2.0}, .value = {3.0, 2.0, 1.0, 0.0}}),
               std::invalid_argument);

  Signal constant = sampled(exponential, {0.1, 0.0, 1.0}, 0.0, 4.0, 50);
  EXPECT_THROW(fit_exponential(constant), std::runtime_error);
  EXPECT_THROW(fit_gaussian(constant), std::runtime_error);
  Signal line{.time = constant.time, .value = constant.time};
  EXPECT_THROW(fit_exponential(line), std::runtime_error);
  EXPECT_THROW(fit_gaussian(line), std::runtime_error);
  // a = exp(1000) here.
  const auto late = [](const std::vector<double>&, double t) { return std::exp(1000.0 - t); };
  EXPECT_THROW(fit_exponential(sampled(late, {}, 1000.0, 4.0, 50)), std::runtime_error);
}
