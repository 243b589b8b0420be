#include "core/analysis/measures.hpp"

#include "core/analysis/signal.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace scarp::analysis {

namespace {

/// The largest value from the sample `first` on.
Peak peak_of(const Signal& signal, std::size_t first) {
  const auto begin = signal.value.begin();
  const auto largest =
      std::max_element(begin + static_cast<std::ptrdiff_t>(first), signal.value.end());
  return {*largest, signal.time[static_cast<std::size_t>(largest - begin)]};
}

} // namespace

SlideMeasures measure(const SlideRecord& record, const MeasureOptions& options) {
  const std::vector<double>& time = record.time;
  const Signal energy{time, record.kinetic_energy};
  check(energy);
  check({time, record.front});
  if (time.empty() || time.back() < options.loading_start)
    throw std::invalid_argument("the record ends before the loading starts");
  const auto sample_at = [&time](double t) { // the first at or after t
    return static_cast<std::size_t>(std::ranges::lower_bound(time, t) - time.begin());
  };

  SlideMeasures measures;
  for (const std::vector<double>& velocity : record.monitor_velocity) {
    const Smoothed smoothed = smooth({time, velocity}, options.smoothing_width);
    measures.monitors.push_back(
        {.velocity = peak_of({time, smoothed.value}, 0),
         .acceleration = peak_of({time, smoothed.rate}, sample_at(options.loading_start))});
  }

  const Peak kinetic = peak_of(energy, 0);
  measures.kinetic_energy = {options.thickness * kinetic.value, kinetic.time};
  measures.run_out = record.front.back() - options.toe;

  const Signal rest{time, record.rest_energy.empty() ? record.kinetic_energy : record.rest_energy};
  check(rest);
  const Peak peak = peak_of(rest, 0);
  std::optional<double> low_since;
  for (std::size_t i = sample_at(peak.time); i < time.size(); ++i) {
    if (rest.value[i] >= options.rest_fraction * peak.value) {
      low_since.reset();
      continue;
    }
    if (!low_since) low_since = time[i];
    if (!measures.first_rest && time[i] - *low_since >= options.rest_duration) {
      measures.first_rest = time[i];
      measures.after_rest_fraction = peak_of(rest, i).value / peak.value;
    }
  }
  measures.rest = low_since;
  return measures;
}

} // namespace scarp::analysis
