// Linear regression.
#pragma once

#include <vector>

namespace scarp::analysis {

/// response = b0 + b1 predictor1 + b2 predictor2 + ... + residual
struct Regression {
  std::vector<double> coefficients;    ///< b0, b1, ...
  std::vector<double> standard_errors; ///< of b0, b1, ..., from the residual deviation
  std::vector<double> residuals;       ///< in the response's order and unit
  double r2;                           ///< coefficient of determination; NaN: constant response
  double residual_deviation;           ///< sqrt(sum of squares / (rows - coefficients))
};

/// Ordinary least squares.  `predictors` holds a column a predictor, without the constant.
/// Throws std::invalid_argument when a column is not as long as the response, when there are not
/// more rows than coefficients, and when the predictors and the constant are linearly dependent.
Regression regress(const std::vector<std::vector<double>>& predictors,
                   const std::vector<double>& response);

} // namespace scarp::analysis
