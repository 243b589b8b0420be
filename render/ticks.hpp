// Round numbers for axes and colour bars.
#pragma once

#include <string>
#include <vector>

namespace scarp::render {

/// The smallest round number (1, 2, 2.5 or 5 times a power of ten) not below `least` > 0.
double round_step(double least);

/// Multiples of a round step within [lower, upper], at most `most` >= 2 of them (one more if both
/// ends are hit).
std::vector<double> ticks(double lower, double upper, int most);

/// Labels with as many digits after the point as the ticks need to differ, the same for all; large
/// and small values share a power of ten, given by common_power().
std::vector<std::string> tick_labels(const std::vector<double>& ticks, int power = 0);

/// The power of ten (a multiple of 3) to take out of the labels: 0 between 0.001 and 99 999.
int common_power(const std::vector<double>& ticks);

/// "(m/s)" and power 3 give "(10³ m/s)"; no brackets for an empty unit and power 0.
std::string unit_label(const std::string& unit, int power);

} // namespace scarp::render
