#include "render/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scarp::render {

namespace {

/// Digits after the point that tell a round step's multiples apart.
int digits_after_point(double value) {
  constexpr int most = 9;
  constexpr double nearly = 1e-6;
  for (int digits = 0; digits < most; ++digits) {
    const double scaled = value * std::pow(10.0, digits);
    if (std::abs(scaled - std::round(scaled)) <= nearly * std::max(1.0, std::abs(scaled)))
      return digits;
  }
  return most;
}

std::string superscript(int number) {
  static const std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴",
                                                     "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number)))
    text += digits.at(static_cast<std::size_t>(digit - '0'));
  return text;
}

} // namespace

double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  constexpr double slack = 1.0 - 1e-9; // 0.30000000000000004 is 0.3
  for (const double factor : {1.0, 2.0, 2.5, 5.0})
    if (factor * power >= least * slack) return factor * power;
  return 10.0 * power;
}

std::vector<double> ticks(double lower, double upper, int most) {
  if (!(upper > lower)) return {lower};
  const double step = round_step((upper - lower) / most);
  constexpr double slack = 1e-6;
  std::vector<double> values;
  const double last = std::floor(upper / step + slack);
  for (double i = std::ceil(lower / step - slack); i <= last; i += 1.0)
    values.push_back(i * step + 0.0); // no -0
  return values;
}

int common_power(const std::vector<double>& ticks) {
  double largest = 0.0;
  for (const double tick : ticks) largest = std::max(largest, std::abs(tick));
  if (largest == 0.0 || (largest >= 1e-2 && largest < 1e5)) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(largest * (1.0 + 1e-9)) / 3.0));
}

std::vector<std::string> tick_labels(const std::vector<double>& ticks, int power) {
  const double scale = std::pow(10.0, -power);
  int digits = 0;
  for (const double tick : ticks) digits = std::max(digits, digits_after_point(tick * scale));
  std::vector<std::string> labels;
  for (const double tick : ticks) {
    std::string label = fmt::format("{:.{}f}", std::abs(tick * scale), digits);
    const bool negative = tick < 0.0 && label.find_first_not_of("0.") != std::string::npos;
    labels.push_back(negative ? fmt::format("−{}", label) : label);
  }
  return labels;
}

std::string unit_label(const std::string& unit, int power) {
  if (power == 0) return unit.empty() ? "" : fmt::format("({})", unit);
  return unit.empty() || unit == "-" ? fmt::format("(10{})", superscript(power))
                                     : fmt::format("(10{} {})", superscript(power), unit);
}

} // namespace scarp::render
