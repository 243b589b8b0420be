#include "apps/safety_search.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace scarp::apps {

Bracket find_bracket(const SearchOptions& options, const std::function<bool(double)>& fails) {
  if (!(options.tolerance > 0.0 && options.lower > 0.0 && options.upper > options.lower))
    throw std::invalid_argument("find_bracket: 0 < lower < upper, 0 < tolerance are necessary");
  std::map<double, bool> failed;
  const auto try_factor = [&](double factor) {
    const auto [at, first] = failed.try_emplace(factor, false);
    if (first) at->second = fails(factor);
    return at->second;
  };

  const bool lower_fails = try_factor(options.lower);
  const bool upper_fails = try_factor(options.upper);
  if (!lower_fails && upper_fails) {
    double stable = options.lower;
    double unstable = options.upper;
    while (unstable - stable > options.tolerance) {
      const double middle = 0.5 * (stable + unstable);
      if (!(middle > stable && middle < unstable)) break; // finer than numbers are
      (try_factor(middle) ? unstable : stable) = middle;
    }
    try_factor(std::max(options.lower, stable - options.tolerance));
    try_factor(std::min(options.upper, unstable + options.tolerance));
  }

  Bracket bracket;
  for (const auto& [factor, fell] : failed) {
    if (fell && !bracket.failed) bracket.failed = factor;
    if (!fell && !bracket.failed) bracket.stable = factor;
    if (!fell && bracket.failed) bracket.monotone = false;
  }
  return bracket;
}

} // namespace scarp::apps
