#include "core/analysis/slide_stages.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace scarp::analysis {

std::optional<SlideStages> find_stages(const std::vector<double>& time, const Smoothed& toe,
                                       double loading, double energy_peak, double rest) {
  if (toe.value.size() != time.size() || toe.rate.size() != time.size() || time.empty())
    throw std::invalid_argument("the toe's velocity and the times do not go together");
  if (!(loading <= energy_peak && energy_peak <= rest))
    throw std::invalid_argument("the loading, the peak of the energy and the rest do not follow "
                                "each other");
  const std::size_t start =
      static_cast<std::size_t>(std::ranges::lower_bound(time, loading) - time.begin());
  std::size_t peak = start;
  for (std::size_t i = start; i < time.size(); ++i)
    if (toe.value[i] > toe.value[peak]) peak = i;
  std::size_t half = start;
  while (half < peak && toe.value[half] < 0.5 * toe.value[peak]) ++half;

  // The rate rises at the loading, falls to the creep and rises again.
  std::size_t creep = start;
  std::size_t first_rise = start;
  double fall = 0.0;
  for (std::size_t i = start, most = start; i < half; ++i) {
    if (toe.rate[i] > toe.rate[most]) most = i;
    if (toe.rate[most] - toe.rate[i] > fall) {
      fall = toe.rate[most] - toe.rate[i];
      creep = i;
      first_rise = most;
    }
  }
  const double creep_velocity = toe.value[creep];
  if (first_rise == creep || creep + 1 >= half || creep_velocity <= 0.0) return std::nullopt;

  std::size_t begin = start;
  while (toe.value[begin] < 0.9 * creep_velocity) ++begin;
  std::size_t end = half;
  while (toe.value[end] > 1.1 * creep_velocity) --end;
  return SlideStages{.compression = loading,
                     .creep = time[begin],
                     .acceleration = time[end],
                     .deceleration = std::max(energy_peak, time[end]),
                     .rest = rest,
                     .creep_velocity = creep_velocity};
}

} // namespace scarp::analysis
