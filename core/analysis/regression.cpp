#include "core/analysis/regression.hpp"

#include "core/analysis/least_squares.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace scarp::analysis {

Regression regress(const std::vector<std::vector<double>>& predictors,
                   const std::vector<double>& response) {
  const std::size_t rows = response.size(), unknowns = predictors.size() + 1;
  if (rows <= unknowns)
    throw std::invalid_argument(std::to_string(rows) + " rows are too few for " +
                                std::to_string(unknowns) + " coefficients");
  const Eigen::VectorXd y = as_vector(response);
  Eigen::MatrixXd design(rows, unknowns);
  design.col(0).setOnes();
  for (std::size_t i = 0; i < predictors.size(); ++i) {
    if (predictors[i].size() != rows)
      throw std::invalid_argument("predictor " + std::to_string(i + 1) + " has " +
                                  std::to_string(predictors[i].size()) + " rows, the response " +
                                  std::to_string(rows));
    design.col(static_cast<Eigen::Index>(i) + 1) = as_vector(predictors[i]);
  }

  const ScaledQr qr(design);
  if (qr.rank() < design.cols())
    throw std::invalid_argument("only " + std::to_string(qr.rank()) + " of the " +
                                std::to_string(unknowns) +
                                " columns (constant and predictors) are linearly independent");
  const Eigen::VectorXd b = qr.solve(y);
  const Eigen::VectorXd residuals = y - design * b;
  const double deviation = residuals.norm() / std::sqrt(static_cast<double>(rows - unknowns));
  return {.coefficients = as_list(b),
          .standard_errors = as_list(deviation * qr.inverse_normal_matrix().diagonal().cwiseSqrt()),
          .residuals = as_list(residuals),
          .r2 = r2(y, residuals),
          .residual_deviation = deviation};
}

} // namespace scarp::analysis
