// Errors to a converged solution that no one knows but from runs on ever finer cells.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace scarp::bench {

/// It lies between two numbers.
struct ConvergedError {
  double error = 0.0; ///< -; NaN: nothing is known of it
  double lower = 0.0;
  double upper = 0.0; ///< infinity: the error is only known to be at least `error`
};

/// What the runs of one method, coarse to fine, say of the solution they converge to.
struct Converged {
  std::vector<ConvergedError> errors; ///< of each run
  std::string verdict;                ///< in words
  std::optional<double> value = {};   ///< of the answer's first number; none: not known
  double bar = 0.0;                   ///< to either side of `value`
};

/// A judge takes cell sizes, coarse to fine, and what each run answered.
using Answers = std::vector<std::vector<double>>;

/// The finest run stands for the converged solution, at an error that is not known; the others have
/// the RMS of their differences to it.
Converged to_finest(const std::vector<double>& cell_size, const Answers& answer);

/// The first number of the answers, extrapolated from the last three (extrapolation.hpp), and
/// relative errors to it.  If there is no such value, the errors are the least they can be if finer
/// cells go on in the same sense: the differences to the finest run.
Converged to_extrapolated(const std::vector<double>& cell_size, const Answers& answer);

} // namespace scarp::bench
