// The generalised vortex: a ring of material turned about its axis, each radius by its own angle,
// held on its way by a body force worked out beforehand (a manufactured solution, after Brannon,
// Kamojjala & Sadeghirad 2011, "Establishing credibility of particle methods through verification
// testing", Particles 2011, whose material is hyperelastic; the force here is that of scarp's law).
//
// Motion.  r = R, theta = Theta + alpha(R, t), alpha = g(t) h(R), with s = (R - 1)/a,
//   h = (1 - s^2)^4 for |s| < 1, else 0;   g = A sin^4(pi t / T):
// both begin and end smoothly (h: three continuous derivatives, g: no acceleration at t = 0).
//
// Stress.  In the frame (e_r, e_theta) at the point's place F = [[1, 0], [gamma, 1]],
// gamma = R alpha': simple shear, J = 1.  The frame turns with omega = d alpha/dt; the spin
// relative to it is w_r_theta = - gamma_dot/2, and D_r_theta = gamma_dot/2.  So the Jaumann law d
// tau/dt = w tau - tau w + 2 G D says, by components,
//   d tau_rr/dt = - gamma_dot tau_rt,   d tau_tt/dt = gamma_dot tau_rt,
//   d tau_rt/dt = G gamma_dot - gamma_dot (tau_tt - tau_rr)/2,
// which from 0 gives, whatever the path,
//   tau_rt = G sin(gamma),   tau_tt = - tau_rr = G (1 - cos(gamma)).
//
// Body force b = a - div(sigma)/rho, with
//   a_r = - R omega^2,   a_t = R d2 alpha/dt2,
//   (div sigma)_r = d sigma_rr/dR + (sigma_rr - sigma_tt)/R
//                 = - G (sin(gamma) gamma' + 2 (1 - cos(gamma))/R),
//   (div sigma)_t = d sigma_rt/dR + 2 sigma_rt/R = G (cos(gamma) gamma' + 2 sin(gamma)/R).
#pragma once

#include "apps/bench/bar.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace scarp::bench {

struct Vortex {
  double amplitude = 0.5; ///< rad, A; gamma goes up to 3.9 A

  /// Where the point that is at `place` (m, x y z) at time 0 is at `time` (s).
  std::array<double, 3> position(const std::array<double, 3>& place, double time) const;
  /// m/s2, at a place at that time.
  std::array<double, 3> force(const std::array<double, 3>& place, double time) const;
  /// Pa, rr tt rt.
  std::array<double, 3> stress(double radius, double time) const;
};

struct VortexRun {
  /// -, sqrt(sum V |u - u_exact|^2 / sum V |u_exact|^2) at the largest turn, T/2
  double error;
  /// -, the same of the stress's r-theta component
  double stress_error;
  std::size_t points;
  long steps;
};

/// From rest to the largest turn, with so many cells a metre.
VortexRun run_vortex(const Vortex& vortex, int cells, const Discretisation& how);

} // namespace scarp::bench
