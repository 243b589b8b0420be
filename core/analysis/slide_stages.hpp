// The four stages of a thrust-type slide under a surcharge (Wu et al. 2017, section 3), found in a
// run's record.
#pragma once

#include "core/analysis/signal.hpp"

#include <optional>

namespace scarp::analysis {

/// Times at which stages begin and the last one ends, s.
///   I   crest compression, from the loading on;
///   II  local creep: the toe moves at a speed that hardly changes;
///   III accelerated sliding: the mass shears out, the toe leaves its creep;
///   IV  decelerated sliding, from the peak of the kinetic energy to rest.
struct SlideStages {
  double compression; ///< s, the loading
  double creep;
  double acceleration;
  double deceleration;
  double rest;
  double creep_velocity; ///< m/s, of the toe
};

/// `toe`: smoothed horizontal velocity of a point at the toe and its rate.  The toe's creep
/// velocity is that at the smallest rate between the first largest rate after the loading and the
/// toe's reaching half of its peak velocity.  Creep begins when the toe first has nine tenths of it
/// and ends when it last has, before half of the peak, no more than eleven tenths of it. Nothing if
/// there is no such minimum: the toe speeds up without a creep before it. Throws
/// std::invalid_argument if times and values do not go together or the order of the times loading
/// <= energy_peak <= rest is broken.
std::optional<SlideStages> find_stages(const std::vector<double>& time, const Smoothed& toe,
                                       double loading, double energy_peak, double rest);

} // namespace scarp::analysis
