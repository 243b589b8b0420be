// A quantity over time, and its smoothing.
#pragma once

#include <vector>

namespace scarp::analysis {

struct Signal {
  std::vector<double> time;  ///< s, increasing, not necessarily in even steps
  std::vector<double> value; ///< in any unit
};

/// Throws std::invalid_argument unless there are as many values as times, all of them finite and
/// every time later than the one before.
void check(const Signal& signal);

/// At every sample of a signal.
struct Smoothed {
  std::vector<double> value; ///< in the signal's unit
  std::vector<double> rate;  ///< first derivative, in the signal's unit per second
};

/// Replaces every sample by the least-squares parabola through the samples at most width / 2 before
/// or after it, all with equal weight: its value and its slope at the sample's time (Savitzky A.,
/// Golay M. J. E. (1964), Anal. Chem. 36(8):1627-1639, doi 10.1021/ac60214a047; the times need not
/// be even).  At the ends the window is cut off.  Two samples in a window give a line, one gives
/// itself and rate 0.
///
/// The width is in s.  Throws std::invalid_argument for a width that is not positive, and what
/// `check` throws.
Smoothed smooth(const Signal& signal, double width);

} // namespace scarp::analysis
