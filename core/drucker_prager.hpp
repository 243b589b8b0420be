// Linear elasticity and the Drucker-Prager return, as small values whose update is inlined into the
// stress pass.
//
// Yield function (tension positive):  f = tau + q_phi sigma_m - k_phi,  tau = sqrt(J2)
//   q_phi = 6 sin(phi) / (sqrt(3) (3 +- sin(phi))),  k_phi = 6 c cos(phi) / (sqrt(3) (3 +-
//   sin(phi)))
// '+' inscribed in Mohr-Coulomb in the pi plane, '-' circumscribed; the plane-strain match is
//   q = 3 tan(phi)/sqrt(9 + 12 tan(phi)^2),  k = 3 c/sqrt(9 + 12 tan(phi)^2).
// Plastic potential: g = tau + q_psi sigma_m.  Tension cut-off: sigma_m <= sigma_t <= k_phi/q_phi.
// Wu et al. 2017, doi 10.16030/j.cnki.issn.1000-3665.2017.06.19; de Souza Neto, Peric & Owen 2008,
// Computational Methods for Plasticity, ch. 8, for the return to smooth cone and apex.
#pragma once

#include "core/scene.hpp"
#include "core/types.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp {

/// Isotropic elastic moduli, Pa.
struct ElasticModuli {
  Real bulk;
  Real shear;

  static ElasticModuli from(Real youngs_modulus, Real poissons_ratio) {
    return {youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio)),
            youngs_modulus / (2.0 * (1.0 + poissons_ratio))};
  }
  /// Pa, modulus of uniaxial strain: the square of the wave speed times the density.
  Real p_wave() const { return bulk + 4.0 / 3.0 * shear; }
};

/// What one stress update did irreversibly.
struct PlasticStep {
  Real strain = 0.0; ///< -, increment of the equivalent plastic strain sqrt(2/3 de:de), deviatoric
  Real dissipation = 0.0; ///< J/m3
};

struct ElasticUpdate {
  template <int Dim> PlasticStep operator()(SymTensor<Dim>&) const { return {}; }
};

struct DruckerPragerUpdate {
  ElasticModuli moduli;
  Real q_phi;
  Real k_phi; ///< Pa
  Real q_psi;
  Real sigma_t; ///< Pa

  static DruckerPragerUpdate from(const DruckerPrager& law, const ElasticModuli& moduli) {
    const auto radians = [](Real degrees) { return degrees * 3.14159265358979323846 / 180.0; };
    const auto slopes = [&](Real angle) -> std::array<Real, 2> { // q and k/c
      const Real s = std::sin(angle), c = std::cos(angle), t = std::tan(angle);
      if (law.cone == Cone::plane_strain) {
        const Real root = std::sqrt(9.0 + 12.0 * t * t);
        return {3.0 * t / root, 3.0 / root};
      }
      const Real below = std::sqrt(3.0) * (law.cone == Cone::inscribed ? 3.0 + s : 3.0 - s);
      return {6.0 * s / below, 6.0 * c / below};
    };
    const auto [q_phi, k_over_c] = slopes(radians(law.friction_angle));
    const Real k_phi = k_over_c * law.cohesion;
    const Real apex = q_phi > 0.0 ? k_phi / q_phi : std::numeric_limits<Real>::infinity();
    return {moduli, q_phi, k_phi, slopes(radians(law.dilation_angle))[0],
            std::min(law.tension_cutoff, apex)};
  }

  /// Takes the elastic trial stress to the admissible one.  The two surfaces are returned to with
  /// two multipliers (Koiter): the cone alone, the cut-off alone, or their common edge.
  template <int Dim> PlasticStep operator()(SymTensor<Dim>& stress) const {
    const Real mean_trial = trace<Dim>(stress) / 3.0;
    SymTensor<Dim> s = stress;
    for (std::size_t i = 0; i < 3; ++i) s[i] -= mean_trial;
    Real J2 = 0.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    for (std::size_t i = 3; i < s.size(); ++i) J2 += s[i] * s[i];
    const Real tau_trial = std::sqrt(J2);

    const Real f = tau_trial + q_phi * mean_trial - k_phi;
    if (f <= 0.0 && mean_trial <= sigma_t) return {};

    Real mean = mean_trial;
    Real tau = tau_trial;
    if (f > 0.0) {
      const Real multiplier = f / (moduli.shear + moduli.bulk * q_phi * q_psi);
      mean = mean_trial - moduli.bulk * q_psi * multiplier;
      tau = k_phi - q_phi * mean;
    }
    if (mean > sigma_t) {
      mean = sigma_t;
      tau = std::min(tau_trial, k_phi - q_phi * sigma_t);
    }
    tau = std::max(tau, 0.0); // rounding at the apex
    const Real scale = tau_trial > 0.0 ? tau / tau_trial : 0.0;
    for (std::size_t i = 0; i < 3; ++i) stress[i] = mean + scale * s[i];
    for (std::size_t i = 3; i < s.size(); ++i) stress[i] = scale * s[i];

    // e_p = (s_trial - s) / 2G, so sqrt(2/3 e_p:e_p) = (tau_trial - tau) / (sqrt(3) G).
    const Real slip = (tau_trial - tau) / moduli.shear;
    return {slip / std::sqrt(3.0), tau * slip + mean * (mean_trial - mean) / moduli.bulk};
  }
};

} // namespace scarp
