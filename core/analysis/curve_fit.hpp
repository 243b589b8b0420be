// Curves through the velocities of a slide: equations 20-23 of Wu F. et al. (2017), Hydrogeology &
// Engineering Geology 44(6):126-134, doi 10.16030/j.cnki.issn.1000-3665.2017.06.19.
#pragma once

#include "core/analysis/signal.hpp"

#include <functional>
#include <string>
#include <vector>

namespace scarp::analysis {

struct CurveFit {
  std::vector<std::string> names;         ///< of the parameters, as in the equation
  std::vector<double> values;             ///< of the parameters; times in s, the others in v's unit
  std::vector<double> standard_errors;    ///< of the values, linearised at the solution
  std::vector<double> residuals;          ///< v - curve at every sample
  double r2;                              ///< coefficient of determination
  std::function<double(double)> evaluate; ///< the curve at the signal's time t, s
};

/// v = y0 + a exp(-t / tau) by least squares (eqs. 20, 21).  t is the signal's own time, so `a` is
/// the curve's height above y0 at t = 0, be it far outside the samples.  tau < 0: the curve leaves
/// y0 as time goes on.
///
/// Levenberg-Marquardt over tau, to which y0 and `a` are the linear fit, from the best of a series
/// of starts.  Throws std::invalid_argument for fewer samples than parameters + 1 and what `check`
/// throws; std::runtime_error when it does not converge, when the samples do not determine the
/// parameters (a constant, a straight line), and when `a` is beyond the range of numbers.
CurveFit fit_exponential(const Signal& signal);

/// v = y0 + a exp(-(t - t0)^2 / (2 w^2)), w > 0, t the signal's own time (eqs. 22, 23).  As above.
CurveFit fit_gaussian(const Signal& signal);

} // namespace scarp::analysis
