#include "core/analysis/signal.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

namespace scarp::analysis {

namespace {

struct Estimate {
  double value;
  double rate;
};

/// The least-squares parabola's value and slope at the time `at`, in the polynomials that are
/// orthogonal over the samples: 1, x and q(x) = x^2 - b x - c, x from the mean time (Forsythe G. E.
/// (1957), J. SIAM 5(2):74-88).
Estimate fit_parabola(std::span<const double> time, std::span<const double> value, double at) {
  const auto count = static_cast<double>(time.size());
  double mean_time = 0.0, mean_value = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    mean_time += (time[i] - at) / count;
    mean_value += value[i] / count;
  }
  if (time.size() == 1) return {mean_value, 0.0};

  const auto x = [&](std::size_t i) { return time[i] - at - mean_time; };
  double sum_xx = 0.0, sum_xxx = 0.0, sum_xv = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    sum_xx += x(i) * x(i);
    sum_xxx += x(i) * x(i) * x(i);
    sum_xv += x(i) * (value[i] - mean_value);
  }
  const double slope = sum_xv / sum_xx;
  const Estimate line = {mean_value - slope * mean_time, slope};

  const double b = sum_xxx / sum_xx, c = sum_xx / count;
  const auto q = [b, c](double offset) { return offset * (offset - b) - c; };
  double sum_qq = 0.0, sum_qv = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    sum_qq += q(x(i)) * q(x(i));
    sum_qv += q(x(i)) * (value[i] - line.value - slope * (time[i] - at));
  }
  // Zero but for rounding where there are only two times, or all but two coincide.
  if (sum_qq <= 1e-12 * sum_xx * c) return line;
  const double curvature = sum_qv / sum_qq;
  return {line.value + curvature * q(-mean_time), line.rate + curvature * (-2.0 * mean_time - b)};
}

} // namespace

void check(const Signal& signal) {
  if (signal.time.size() != signal.value.size())
    throw std::invalid_argument("a signal of " + std::to_string(signal.time.size()) +
                                " times and " + std::to_string(signal.value.size()) + " values");
  const auto error_at = [](std::size_t i, const std::string& what) {
    return std::invalid_argument("sample " + std::to_string(i) + " of a signal is not " + what);
  };
  for (std::size_t i = 0; i < signal.time.size(); ++i) {
    if (!std::isfinite(signal.time[i]) || !std::isfinite(signal.value[i]))
      throw error_at(i, "finite");
    if (i > 0 && signal.time[i] <= signal.time[i - 1])
      throw error_at(i, "later than the one before");
  }
}

Smoothed smooth(const Signal& signal, double width) {
  check(signal);
  if (!(width > 0.0)) throw std::invalid_argument("the width of smoothing must be positive");
  // Wider by a hair, so that rounding does not decide on samples at the window's edge.
  const double reach = 0.5 * width * (1.0 + 1e-9);
  const std::span<const double> time(signal.time), value(signal.value);
  Smoothed smoothed;
  std::size_t begin = 0, end = 0;
  for (const double at : time) {
    while (time[begin] < at - reach) ++begin;
    while (end < time.size() && time[end] <= at + reach) ++end;
    const Estimate estimate =
        fit_parabola(time.subspan(begin, end - begin), value.subspan(begin, end - begin), at);
    smoothed.value.push_back(estimate.value);
    smoothed.rate.push_back(estimate.rate);
  }
  return smoothed;
}

} // namespace scarp::analysis
