// What answers on ever finer cells say of the answer without cells: Richardson's extrapolation,
// with the grid convergence index of Roache 1994 (J. Fluids Eng. 116:405) as its error bar.
#pragma once

#include <string>
#include <vector>

namespace scarp::bench {

/// How the last three answers follow each other: with differences that shrink, that change sign, or
/// that do not shrink.
enum class Course { converges, oscillates, diverges };

/// Value, order and bar are NaN unless it converges: nothing is known then.
struct Extrapolation {
  Course course;
  double value; ///< at cell size 0, in the answers' unit
  double order; ///< as observed
  double bar;   ///< to either side of the value: 1.25 times what was extrapolated by
};

/// Of the last three.  Throws std::invalid_argument unless there are three, with cells that become
/// smaller by the same factor.
Extrapolation extrapolate(const std::vector<double>& cell_size, const std::vector<double>& answer);

/// Such as "4520 ± 800 (order 1.02)" or "no value: differences do not shrink".
std::string to_text(const Extrapolation& extrapolation);

} // namespace scarp::bench
