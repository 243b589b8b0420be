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
// = eta gamma' with the viscosity eta = b d sqrt(rho p).  The plastic shear of a step being
// gamma = (tau_trial - tau) / G, the law at the end of the step is linear in tau,
//   tau = (cone + r tau_trial) / (1 + r),  r = eta / (G dt):
// implicit, so that it asks for no shorter step.  Pressure is that after the return; for the
// dilation of the step, that before it.
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
            law.rate_strengthening * law.grain_diameter * std::sqrt(density)};
  }

  template <class T> struct Rate {
    T resistance; ///< Pa^-0.5, r / sqrt(p)
    T shear;      ///< Pa

    [[gnu::always_inline]] T r(const T& mean) const {
      using std::max, std::sqrt;
      return resistance * sqrt(max(-mean, T(0.0F)));
    }
    [[gnu::always_inline]] T shear_stress(const T& tau_trial, const T& cone, const T& mean) const {
      using std::max, std::min;
      const T resisting = r(mean);
      return min(tau_trial, (max(cone, T(0.0F)) + resisting * tau_trial) / (1.0F + resisting));
    }
    [[gnu::always_inline]] T inv_hardness(const T& of_cone, const T& mean) const {
      return of_cone / (1.0F + of_cone * shear * r(mean));
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
            {T(number<T>(rate_resistance / (shear * dt))), T(number<T>(shear))}};
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
