// What the linear and the nonlinear fits share.  For the sources of this folder only: it shows
// Eigen.
#pragma once

#include <Eigen/QR>

#include <vector>

namespace scarp::analysis {

/// Column-pivoting Householder QR of a matrix A whose columns are scaled to length 1, so that its
/// rank does not depend on units.
class ScaledQr {
 public:
  explicit ScaledQr(const Eigen::MatrixXd& matrix);

  Eigen::Index rank() const { return qr_.rank(); }
  /// The x of the least |A x - b|; A must be of full rank.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// (A^T A)^-1; A must be of full rank.
  Eigen::MatrixXd inverse_normal_matrix() const;

 private:
  Eigen::VectorXd scale_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
};

/// 1 - (sum of squares of the residuals) / (of the response about its mean); NaN if the response is
/// constant.
double r2(const Eigen::VectorXd& response, const Eigen::VectorXd& residuals);

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values);
std::vector<double> as_list(const Eigen::VectorXd& values);

} // namespace scarp::analysis
