#include "apps/bench/converged.hpp"

#include "apps/bench/extrapolation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace scarp::bench {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Differences to the last answer are what errors are at least.
Converged no_value(const std::vector<double>& answer, std::string verdict) {
  Converged converged = {{}, std::move(verdict)};
  for (const double one : answer) {
    const double error = std::abs(one / answer.back() - 1.0);
    converged.errors.push_back({error, error, infinite});
  }
  if (!answer.empty()) converged.errors.back() = {unknown, 0.0, infinite};
  return converged;
}

} // namespace

Converged to_finest(const std::vector<double>& cell_size, const Answers& answer) {
  Converged converged;
  for (const std::vector<double>& one : answer) {
    double sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) sum += std::pow(one[i] - answer.back()[i], 2);
    const double rms = std::sqrt(sum / static_cast<double>(one.size()));
    converged.errors.push_back({rms, rms, rms});
  }
  if (answer.empty()) return converged;
  converged.errors.back() = {unknown, 0.0, infinite};
  converged.verdict = fmt::format("cells of {:.4g} m stand for it", cell_size.back());
  return converged;
}

Converged to_extrapolated(const std::vector<double>& cell_size, const Answers& answer) {
  std::vector<double> first;
  for (const std::vector<double>& one : answer) first.push_back(one.front());
  if (first.size() < 3) return no_value(first, "no value: fewer than three cell sizes");
  Extrapolation found;
  try {
    found = extrapolate(cell_size, first);
  } catch (const std::invalid_argument&) { // a run between them failed
    return no_value(first, "no value: cells do not shrink by one factor");
  }
  if (found.course != Course::converges) return no_value(first, to_text(found));
  Converged converged = {{}, to_text(found), found.value, found.bar};
  for (const double one : first) {
    const double off = std::abs(one - found.value);
    converged.errors.push_back({off / std::abs(found.value),
                                std::max(0.0, off - found.bar) / std::abs(found.value),
                                (off + found.bar) / std::abs(found.value)});
  }
  return converged;
}

} // namespace scarp::bench
