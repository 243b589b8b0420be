// Drucker-Prager whose strength changes with the plastic strain and with the rate of shear.
//
// Softening.  Cone and potential go from the initial to the residual state linearly with the
// equivalent plastic strain e, between e_0 and e_1, as in most codes for landslides:
//   a = min(max((e - e_0) / (e_1 - e_0), 0), 1),  q = q_0 + a (q_1 - q_0), and so k and q_psi.
// With a residual dilation of 0 it is dilatancy that ends in a critical state: shear alone makes
//   sqrt(3) q_psi (e_0 + e_1) / 2
// of volumetric strain and no more.  The state is that before the step, of first order in the
// plastic strain of a step, which is about 1e-5.
//
// Rate.  Grains of diameter d and density rho that are sheared fast under the pressure p resist
// with
//   tau = k + (q + b I) p,  I = gamma' d sqrt(rho / p)  (the inertial number),
// the linear law of dense flows of disks, with b of order 1 (da Cruz, Emam, Prochnow, Roux &
// Chevoir 2005, doi 10.1103/PhysRevE.72.021309; MiDi 2004, doi 10.1140/epje/i2003-10153-0).  b I p
// = eta gamma' with the viscosity eta = b d sqrt(rho p).  Faster flows resist less than that: with
// a limit l the slope's growth is b I / (1 + b I / l) (Jop, Forterre & Pouliquen 2006, doi
// 10.1038/nature04801: l = mu_2 - mu_s, b = l / I_0).
//
// The law holds at the end of the step, so that it asks for no shorter one.  The plastic shear of
// the step being s / G, s = tau_trial - tau, what is beyond the cone, e, is borne by that and by
// the rate,
//   e = a s + r s / (1 + r s / (l p)),  r = eta / (G dt),
// with a = 1, or 1 + K q q_psi / G where dilation presses: a quadratic equation in s.  Pressure is
// that after the return; for the dilation of the step, that before it.
#pragma once

#include "core/drucker_prager.hpp"

namespace scarp {

struct EvolvingStrengthUpdate {
  ReturnModuli moduli;
  Real shear;       ///< Pa
  Real cut_off;     ///< Pa
  Real peak_strain; ///< -, e_0
  Real per_strain;  ///< -, 1 / (e_1 - e_0)
  Cones initial;
  Cones change;         ///< from the initial to the residual state
  Real rate_resistance; ///< kg^0.5 m^-0.5, b d sqrt(rho)
  Real inv_limit;       ///< -, 1 / l

  /// density: kg/m3.
  static EvolvingStrengthUpdate from(const DruckerPrager& law, const ElasticModuli& moduli,
                                     Real density) {
    const Cones first = Cones::of(law), last = Cones::of(law.at_residual());
    return {ReturnModuli(moduli),
            moduli.shear,
            law.tension_cutoff,
            law.residual.peak_strain,
            1.0 / (law.residual.residual_strain - law.residual.peak_strain),
            first,
            {last.q - first.q, last.k - first.k, last.q_psi - first.q_psi},
            law.rate_strengthening * law.grain_diameter * std::sqrt(density),
            1.0 / law.rate_strengthening_limit};
  }

  template <class T> struct Rate {
    T resistance; ///< Pa^-0.5, r / sqrt(p)
    T inv_limit;  ///< -, 1 / l
    T shear;      ///< Pa

    /// Pa, s >= 0; see above.
    [[gnu::always_inline]] T slip(const T& e, const T& a, const T& mean) const {
      using std::max, std::sqrt;
      const T pressure = max(-mean, 1e-12F * shear); // below it nothing is borne
      const T root_p = sqrt(pressure);
      const T r = resistance * root_p, by_limit = resistance * inv_limit / root_p; // r / (l p)
      // a by_limit s^2 + b s = e, by that formula for s which cancels nothing.
      const T b = a + r - e * by_limit;
      const T root = sqrt(b * b + 4.0F * a * by_limit * e);
      constexpr auto least = std::numeric_limits<typename NumberIn<T>::type>::min();
      return choose(b >= 0.0F, 2.0F * e / max(b + root, T(least)),
                    (root - b) / max(2.0F * a * by_limit, T(least)));
    }
    [[gnu::always_inline]] T shear_stress(const T& tau_trial, const T& cone, const T& mean) const {
      using std::max;
      return tau_trial - slip(max(tau_trial - max(cone, T(0.0F)), T(0.0F)), T(1.0F), mean);
    }
    [[gnu::always_inline]] T multiplier(const T& beyond, const T& inv_hardness,
                                        const T& mean) const {
      return slip(beyond, 1.0F / (inv_hardness * shear), mean) / shear;
    }
  };

  /// The law of points in one step.
  template <class T> struct InStep {
    ReturnModuli moduli;
    YieldSurface<T> surface;
    Rate<T> rate;

    template <int Dim, class>
    [[gnu::always_inline]] PlasticStep<T> operator()(SymTensor<Dim, T>& stress, T& gap,
                                                     const T& room) const {
      return return_to<Dim, T>(surface, moduli, stress, gap, room, rate);
    }
  };

  /// strain: -, equivalent plastic strain before the step.  dt: s; infinity: rate does not count.
  template <class T> [[gnu::always_inline]] InStep<T> in_step(const T& strain, Real dt) const {
    using std::max, std::min;
    const T a =
        min(max((strain - number<T>(peak_strain)) * number<T>(per_strain), T(0.0F)), T(1.0F));
    const auto now = [&](Real first, Real by) __attribute__((always_inline))->T {
      return number<T>(first) + a * number<T>(by);
    };
    const T q = now(initial.q, change.q), k = now(initial.k, change.k);
    const T bulk_q_psi = number<T>(moduli.bulk) * now(initial.q_psi, change.q_psi);
    constexpr auto least = std::numeric_limits<typename NumberIn<T>::type>::min();
    const T apex = k / max(q, T(least)); // without friction practically infinite
    return {moduli,
            {q, k, min(T(number<T>(cut_off)), apex), bulk_q_psi,
             1.0F / (number<T>(shear) + bulk_q_psi * q)},
            {T(number<T>(rate_resistance / (shear * dt))), T(number<T>(inv_limit)),
             T(number<T>(shear))}};
  }
};

/// The law of points in one step, see EvolvingStrengthUpdate::in_step; most do not depend on it.
template <class T, class Law> const Law& law_in_step(const Law& law, const T&, Real) { return law; }
template <class T>
[[gnu::always_inline]] inline EvolvingStrengthUpdate::InStep<T>
law_in_step(const EvolvingStrengthUpdate& law, const T& strain, Real dt) {
  return law.in_step(strain, dt);
}

} // namespace scarp
