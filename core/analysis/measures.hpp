// The measures of a slide, defined once, so that runs and programs can be compared.
#pragma once

#include <optional>
#include <vector>

namespace scarp::analysis {

/// What was recorded; all series have a value for every time.
struct SlideRecord {
  std::vector<double> time;                          ///< s, increasing
  std::vector<std::vector<double>> monitor_velocity; ///< m/s, by monitor: along x, the slide's way
  std::vector<double> kinetic_energy;                ///< J per metre of depth
  /// J per metre of depth, what rest is judged on: the nodes' kinetic energy, without the motion of
  /// the points that moves nothing.  Empty: kinetic_energy.
  std::vector<double> rest_energy;
  std::vector<double> front; ///< m, largest x of the slide
};

struct MeasureOptions {
  double smoothing_width = 0.5; ///< s, of the velocities: see smooth() in signal.hpp
  double rest_fraction = 1e-3;  ///< of the peak of the rest energy; less is rest
  double rest_duration = 0.5;   ///< s, how long before it counts for `first_rest`
  double loading_start = 0.0;   ///< s; no acceleration counts before
  double toe = 0.0;             ///< m, x of the slope's toe
  double thickness = 1.0;       ///< m, of the slice that energies are given for
};

struct Peak {
  double value;
  double time; ///< s, of the (first) sample with this value
};

struct MonitorMeasures {
  Peak velocity;     ///< m/s, of the smoothed velocity
  Peak acceleration; ///< m/s2, of its rate, at samples from loading_start on.  The smoothing itself
                     ///< also sees the samples before
};

struct SlideMeasures {
  std::vector<MonitorMeasures> monitors; ///< in the record's order
  Peak kinetic_energy;                   ///< J, not smoothed, times the thickness
  double run_out;                        ///< m, from the toe to the last front

  /// s, the first sample from which on the rest energy stays below rest_fraction of its peak to the
  /// end of the record; none if it is not below at the end.
  std::optional<double> rest;

  /// s, the first sample after the peak at which the rest energy has been below rest_fraction of
  /// the peak for rest_duration; none if it never has.
  std::optional<double> first_rest;
  /// The largest rest energy from first_rest on, by its peak.  More than rest_fraction: the
  /// slide came to rest and then gained energy.
  std::optional<double> after_rest_fraction;
};

/// Throws std::invalid_argument for series of different lengths, times that do not increase, values
/// that are not finite, a smoothing width that is not positive, an empty record, and one that ends
/// before loading_start.
SlideMeasures measure(const SlideRecord& record, const MeasureOptions& options);

} // namespace scarp::analysis
