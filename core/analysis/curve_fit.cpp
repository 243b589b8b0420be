#include "core/analysis/curve_fit.hpp"

#include "core/analysis/least_squares.hpp"

#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace scarp::analysis {

namespace {

using Eigen::ArrayXd, Eigen::MatrixXd, Eigen::VectorXd;

/// A curve is v = y0 + a g(s; q), s = t - (first time).  Its shape gives g and the derivatives of g
/// by the unknowns q, a column each.
using Shape = MatrixXd (*)(const VectorXd& q, const VectorXd& s);

/// q = 1 / tau: unlike tau it passes through the straight line between rise and fall.
MatrixXd exponential(const VectorXd& q, const VectorXd& s) {
  const ArrayXd g = (-q[0] * s.array()).exp();
  MatrixXd columns(s.size(), 2);
  columns << g, -s.array() * g;
  return columns;
}

/// q = (t0 - first time, w)
MatrixXd gaussian(const VectorXd& q, const VectorXd& s) {
  const ArrayXd u = (s.array() - q[0]) / q[1];
  const ArrayXd g = (-0.5 * u.square()).exp();
  MatrixXd columns(s.size(), 3);
  columns << g, u * g / q[1], u.square() * g / q[1];
  return columns;
}

VectorXd centred(const VectorXd& values) { return values.array() - values.mean(); }

/// The fit with q as its only unknowns, as Eigen's solver asks for it: y0 and a are those of the
/// linear fit to g.  Such a fit needs no start for them and converges from afar (Kaufman L. (1975),
/// BIT 15:49-57, doi 10.1007/BF01932995, whose Jacobian this is).
struct Problem {
  Shape shape;
  VectorXd s;
  VectorXd v;

  double height(const VectorXd& g) const {
    const VectorXd dg = centred(g);
    return dg.dot(centred(v)) / dg.squaredNorm();
  }

  int values() const { return static_cast<int>(v.size()); }
  int operator()(const VectorXd& q, VectorXd& misfit) const {
    const VectorXd g = shape(q, s).col(0);
    misfit = height(g) * centred(g) - centred(v);
    return 0;
  }
  int df(const VectorXd& q, MatrixXd& jacobian) const {
    const MatrixXd columns = shape(q, s);
    const VectorXd dg = centred(columns.col(0));
    const double a = height(columns.col(0));
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const VectorXd d = centred(columns.col(i + 1));
      jacobian.col(i) = a * (d - dg.dot(d) / dg.squaredNorm() * dg);
    }
    return 0;
  }
};

/// The start with the least misfit among those whose `a` has the sign.
VectorXd best_start(const Problem& problem, const std::vector<VectorXd>& starts, double sign) {
  return *std::ranges::min_element(starts, {}, [&](const VectorXd& q) {
    const VectorXd g = problem.shape(q, problem.s).col(0);
    VectorXd misfit;
    problem(q, misfit);
    return sign * problem.height(g) > 0.0 ? misfit.squaredNorm()
                                          : std::numeric_limits<double>::infinity();
  });
}

struct Solution {
  VectorXd x;          ///< y0, a, q
  MatrixXd covariance; ///< of x
  VectorXd residuals;
};

Solution solve(const Problem& problem, const std::vector<VectorXd>& starts) {
  if (problem.v.minCoeff() == problem.v.maxCoeff())
    throw std::runtime_error("a constant signal determines no curve");
  VectorXd q, misfit;
  bool converged = false;
  // Part of a peak can look like part of a dip: from the best start of either kind.
  for (const double sign : {1.0, -1.0}) {
    VectorXd candidate = best_start(problem, starts, sign);
    Eigen::LevenbergMarquardt<const Problem> solver(problem);
    solver.parameters.maxfev = 1000;
    solver.parameters.ftol = solver.parameters.xtol = 1e-12;
    const auto status = solver.minimize(candidate);
    if (misfit.size() > 0 && !(solver.fnorm < misfit.norm())) continue;
    q = candidate;
    misfit = solver.fvec;
    converged = status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation;
  }
  if (!converged) throw std::runtime_error("the curve fit does not converge");

  const MatrixXd columns = problem.shape(q, problem.s);
  const double a = problem.height(columns.col(0));
  VectorXd x(q.size() + 2);
  x << problem.v.mean() - a * columns.col(0).mean(), a, q;
  MatrixXd jacobian(problem.v.size(), x.size());
  jacobian << VectorXd::Ones(problem.v.size()), columns.col(0), a * columns.rightCols(q.size());
  const ScaledQr qr(jacobian);
  if (qr.rank() < x.size())
    throw std::runtime_error("the samples do not determine the parameters of the curve");
  const auto freedom = static_cast<double>(problem.v.size() - x.size());
  return {.x = x,
          .covariance = misfit.squaredNorm() / freedom * qr.inverse_normal_matrix(),
          .residuals = -misfit};
}

/// Time since the first sample of a signal that is long enough.
VectorXd elapsed_time(const Signal& signal, std::size_t parameters) {
  check(signal);
  if (signal.time.size() <= parameters)
    throw std::invalid_argument(std::to_string(signal.time.size()) +
                                " samples are too few for a curve of " +
                                std::to_string(parameters) + " parameters");
  return as_vector(signal.time).array() - signal.time.front();
}

} // namespace

CurveFit fit_exponential(const Signal& signal) {
  const VectorXd s = elapsed_time(signal, 3), v = as_vector(signal.value);
  const double first = signal.time.front(), span = s[s.size() - 1];
  std::vector<VectorXd> starts;
  for (double rate = 0.125; rate <= 128.0; rate *= 2.0)
    for (const double sign : {1.0, -1.0})
      starts.push_back(VectorXd::Constant(1, sign * rate / span));
  const Solution solution = solve({exponential, s, v}, starts);

  // From (y0, height above y0 at the first sample, 1 / tau) to (y0, a, tau); errors follow the
  // chain rule.
  const double y0 = solution.x[0], height = solution.x[1], rate = solution.x[2];
  const double growth = std::exp(rate * first);
  const Eigen::Vector3d values(y0, height * growth, 1.0 / rate);
  if (!values.allFinite())
    throw std::runtime_error("the exponential's a or tau is beyond the range of numbers: count "
                             "the time from a moment nearer to the samples");
  const Eigen::Matrix3d chain{
      {1.0, 0.0, 0.0}, {0.0, 1.0, first * height}, {0.0, 0.0, -1.0 / (rate * rate)}};
  Eigen::Vector3d errors = (chain * solution.covariance * chain.transpose()).diagonal().cwiseSqrt();
  errors[1] *= growth; // only here, as its square may be beyond the range of numbers
  return {.names = {"y0", "a", "tau"},
          .values = as_list(values),
          .standard_errors = as_list(errors),
          .residuals = as_list(solution.residuals),
          .r2 = r2(v, solution.residuals),
          .evaluate = [=](double t) { return y0 + height * std::exp(-rate * (t - first)); }};
}

CurveFit fit_gaussian(const Signal& signal) {
  const VectorXd s = elapsed_time(signal, 4), v = as_vector(signal.value);
  const double span = s[s.size() - 1];
  std::vector<VectorXd> starts;
  for (int centre = 0; centre <= 32; ++centre) // one within a width of every peak
    for (double width = 1.0 / 64.0; width <= 2.0; width *= 2.0)
      starts.push_back(Eigen::Vector2d(centre / 32.0, width) * span);
  const Solution solution = solve({gaussian, s, v}, starts);

  const double y0 = solution.x[0], a = solution.x[1];
  const double t0 = signal.time.front() + solution.x[2], w = std::abs(solution.x[3]);
  return {.names = {"y0", "a", "t0", "w"},
          .values = {y0, a, t0, w},
          .standard_errors = as_list(solution.covariance.diagonal().cwiseSqrt()),
          .residuals = as_list(solution.residuals),
          .r2 = r2(v, solution.residuals),
          .evaluate = [=](double t) {
            return y0 + a * std::exp(-0.5 * (t - t0) * (t - t0) / (w * w));
          }};
}

} // namespace scarp::analysis
