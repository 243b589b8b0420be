#include "core/analysis/least_squares.hpp"

#include <limits>

namespace scarp::analysis {

ScaledQr::ScaledQr(const Eigen::MatrixXd& matrix) : scale_(matrix.colwise().norm().cwiseInverse()) {
  scale_ = scale_.array().isFinite().select(scale_, 1.0); // a column of zeros stays one
  // Far above what rounding leaves of a dependent column, far below what data leave of another.
  qr_.setThreshold(1e-10);
  qr_.compute(matrix * scale_.asDiagonal());
}

Eigen::VectorXd ScaledQr::solve(const Eigen::VectorXd& b) const {
  return scale_.cwiseProduct(qr_.solve(b));
}

Eigen::MatrixXd ScaledQr::inverse_normal_matrix() const {
  const Eigen::Index n = scale_.size();
  const Eigen::MatrixXd inverse_r = qr_.matrixR().topRows(n).triangularView<Eigen::Upper>().solve(
      Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd root = scale_.asDiagonal() * (qr_.colsPermutation() * inverse_r);
  return root * root.transpose();
}

double r2(const Eigen::VectorXd& response, const Eigen::VectorXd& residuals) {
  if (response.minCoeff() == response.maxCoeff()) return std::numeric_limits<double>::quiet_NaN();
  return 1.0 -
         residuals.squaredNorm() / (response.array() - response.mean()).matrix().squaredNorm();
}

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

std::vector<double> as_list(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

} // namespace scarp::analysis
