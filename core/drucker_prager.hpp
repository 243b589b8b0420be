// Linear elasticity and the Drucker-Prager return, as small values whose update is inlined into the
// stress pass.
//
// Yield function (tension positive):  f = tau + q_phi sigma_m - k_phi,  tau = sqrt(J2)
//   q_phi = 6 sin(phi) / (sqrt(3) (3 +- sin(phi))),  k_phi = 6 c cos(phi) / (sqrt(3) (3 +-
//   sin(phi)))
// '+' inscribed in Mohr-Coulomb in the pi plane, '-' circumscribed; the plane-strain match is
//   q = 3 tan(phi)/sqrt(9 + 12 tan(phi)^2),  k = 3 c/sqrt(9 + 12 tan(phi)^2).
// Plastic potential: g = tau + q_psi sigma_m.  Tension cut-off: sigma_m <= sigma_t <= k_phi/q_phi.
//
// Opening.  The cut-off on its own is perfectly plastic: material stretched at it opens a gap, and
// when it closes again its pressure returns at once, with the gap still there.  Every cycle leaves
// the material larger, which shows as a spurious dilation (strength, and points that hover a cell
// above the ground they lie on).  With Opening::remembered the volumetric law is the unilateral
// one,
//   sigma_m = min(K (e + gap), sigma_t),  gap = max(0, e + gap - sigma_t/K),
// with e the elastic volumetric strain: the gap has to close before there is pressure.  It is
// non-linear elasticity, so it makes no energy.  Since the strain that a point adds up drifts from
// the room there is, the gap is at most that room (`bound_gap` of core/stress_pass.hpp; the density
// criterion of Dunatunga & Kamrin 2015, doi 10.1017/jfm.2015.383, as a bound from the grid's own
// density): where unloaded material fills the part phi of the space, it is 1/phi times as large
// when it touches, and as a strain that adds up the gap is the logarithm of that, ln(1/phi).
//
// On the common edge of cone and cut-off the cone's multiplier is (tau_trial - tau)/G, and what
// then is left of the strain opens.  That of the cone alone is larger, and its dilation would take
// a part of every opening for good: a point without shear that opens and closes would dilate.
//
// Wu et al. 2017, doi 10.16030/j.cnki.issn.1000-3665.2017.06.19; de Souza Neto, Peric & Owen 2008,
// Computational Methods for Plasticity, ch. 8, for the return to smooth cone and apex.
#pragma once

#include "core/lanes.hpp"
#include "core/scene.hpp"
#include "core/types.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

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

/// Whether a condition holds for all the points that it is asked of.
inline bool everywhere(bool condition) { return condition; }
template <class Mask>
requires(!std::is_same_v<Mask, bool>)
    [[gnu::always_inline]] inline bool everywhere(const Mask& condition) {
  return all_of(condition);
}

/// `yes` where the condition holds, else `no`.
template <class T> T choose(bool condition, const T& yes, const T& no) {
  return condition ? yes : no;
}
template <class Mask, class T>
requires(!std::is_same_v<Mask, bool>) [[gnu::always_inline]] inline T
    choose(const Mask& condition, const T& yes, T no) {
  where(condition, no) = yes;
  return no;
}

/// What one stress update did irreversibly.  T is Real, or a SIMD value that holds several points.
template <class T = Real> struct PlasticStep {
  bool happened = false; ///< to any of the points; else everything below is 0
  /// -, increment of the equivalent plastic strain sqrt(2/3 de:de), deviatoric
  T strain = 0.0F;
  T dissipation = 0.0F; ///< J/m3
  T forgotten = 0.0F;   ///< -, volumetric strain of a gap that the law does not remember
};

struct ElasticUpdate {
  template <int Dim, class T> PlasticStep<T> operator()(SymTensor<Dim, T>&, T&, const T&) const {
    return {};
  }
};

/// Slope and height of the cone for angles in degrees and a cohesion in Pa.
inline std::array<Real, 2> cone_of(Cone cone, Real angle, Real cohesion) {
  const Real radians = angle * 3.14159265358979323846 / 180.0;
  const Real s = std::sin(radians), c = std::cos(radians), t = std::tan(radians);
  if (cone == Cone::plane_strain) {
    const Real root = std::sqrt(9.0 + 12.0 * t * t);
    return {3.0 * t / root, 3.0 / root * cohesion};
  }
  const Real below = std::sqrt(3.0) * (cone == Cone::inscribed ? 3.0 + s : 3.0 - s);
  return {6.0 * s / below, 6.0 * c / below * cohesion};
}

/// Slopes, and height in Pa, of cone and potential.
struct Cones {
  Real q, k, q_psi;

  static Cones of(const DruckerPrager& law) {
    const auto [q, k] = cone_of(law.cone, law.friction_angle, law.cohesion);
    return {q, k, cone_of(law.cone, law.dilation_angle, 0.0)[0]};
  }
};

/// Cone, potential and cut-off that a return needs; Value is a number, or a SIMD value where points
/// differ.
template <class Value> struct YieldSurface {
  Value q;            ///< -
  Value k;            ///< Pa
  Value cut_off;      ///< Pa, the apex at most
  Value bulk_q_psi;   ///< Pa, K q_psi
  Value inv_hardness; ///< 1/Pa, 1 / (G + K q_phi q_psi)
};

/// How the rate of shear counts in a return: not at all.  Otherwise see core/evolving_strength.hpp.
struct RateIndependent {
  /// Shear stress after the step, Pa, from its trial, what the cone bears and the mean stress.
  template <class T>
  [[gnu::always_inline]] T shear_stress(const T& tau_trial, const T& cone, const T&) const {
    using std::min;
    return min(tau_trial, cone);
  }
  /// -, plastic multiplier of the return to the cone, from how far the trial is beyond it (Pa), its
  /// 1/hardness (1/Pa), and the mean stress.
  template <class T, class Value>
  [[gnu::always_inline]] T multiplier(const T& beyond, const Value& inv_hardness, const T&) const {
    return beyond * inv_hardness;
  }
};

/// What a return needs of the elastic moduli.
struct ReturnModuli {
  Real bulk;      ///< Pa
  Real inv_bulk;  ///< 1/Pa
  Real inv_shear; ///< 1/Pa

  explicit ReturnModuli(const ElasticModuli& moduli)
      : bulk(moduli.bulk), inv_bulk(1.0 / moduli.bulk), inv_shear(1.0 / moduli.shear) {}
};

/// Takes the elastic trial stress to the admissible one.  The two surfaces are returned to with
/// two multipliers (Koiter): the cone alone, the cut-off alone, or their common edge.
/// Free of branches but one, so that it works on SIMD values as well: a multiplier that would be
/// negative is zero, and what lies inside both surfaces stays as it is, to the bit.  Where all
/// points do, as most of a slope does most of the time, the return is skipped.
/// `gap` is that before the step and is brought up to date; `room` is its upper bound: 0 with
/// Opening::forgotten.
template <int Dim, class T, class Value, class Rate = RateIndependent>
[[gnu::always_inline]] inline PlasticStep<T>
return_to(const YieldSurface<Value>& surface, const ReturnModuli& moduli, SymTensor<Dim, T>& stress,
          T& gap, const T& room, const Rate& rate = {}) {
  using std::max, std::min, std::sqrt;
  const auto& [q, k, cut_off, bulk_q_psi, inv_hardness] = surface;
  const auto bulk = number<T>(moduli.bulk), inv_bulk = number<T>(moduli.inv_bulk);
  const T mean_trial = trace<Dim, T>(stress) * number<T>(1.0 / 3.0);
  SymTensor<Dim, T> s = stress;
  for (std::size_t i = 0; i < 3; ++i) s[i] -= mean_trial;
  T J2 = 0.5F * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
  for (std::size_t i = 3; i < s.size(); ++i) J2 += s[i] * s[i];
  const T strength = k - q * mean_trial;
  const auto inside =
      mean_trial <= cut_off && strength >= 0.0F && J2 <= strength * strength && gap == 0.0F;
  if (everywhere(inside)) return {};

  const T tau_trial = sqrt(J2);
  const T mean_open = mean_trial + bulk * gap;
  // Of the cone alone.
  const T multiplier =
      rate.multiplier(max(tau_trial - (k - q * mean_open), T(0.0F)), inv_hardness, mean_open);
  const T mean_cone = mean_open - bulk_q_psi * multiplier;
  const T mean = min(mean_cone, T(cut_off));
  const T tau = max(rate.shear_stress(tau_trial, T(k - q * mean), mean), T(0.0F));
  constexpr auto least = std::numeric_limits<typename NumberIn<T>::type>::min();
  const T scale = tau / max(tau_trial, T(least)); // 0/0 is 0: s is 0
  for (std::size_t i = 0; i < 3; ++i) stress[i] = choose(inside, stress[i], mean + scale * s[i]);
  for (std::size_t i = 3; i < s.size(); ++i) stress[i] = choose(inside, stress[i], scale * s[i]);

  // e_p = (s_trial - s) / 2G, so sqrt(2/3 e_p:e_p) = (tau_trial - tau) / (sqrt(3) G).
  const T slip = (tau_trial - tau) * number<T>(moduli.inv_shear);
  const T beyond = max((mean_open - mean - bulk_q_psi * slip) * inv_bulk, T(0.0F));
  const T opening = choose(mean_cone > cut_off, beyond, T(0.0F));
  gap = min(opening, room);
  constexpr Real inv_sqrt3 = 0.57735026918962576451;
  return {true, slip * number<T>(inv_sqrt3),
          tau * slip + mean * ((mean_open - mean) * inv_bulk - gap), opening - gap};
}

struct DruckerPragerUpdate {
  ReturnModuli moduli;
  YieldSurface<Real> surface;

  static DruckerPragerUpdate from(const DruckerPrager& law, const ElasticModuli& moduli) {
    const auto [q, k, q_psi] = Cones::of(law);
    const Real apex = q > 0.0 ? k / q : std::numeric_limits<Real>::infinity();
    return {ReturnModuli(moduli),
            {q, k, std::min(law.tension_cutoff, apex), moduli.bulk * q_psi,
             1.0 / (moduli.shear + moduli.bulk * q * q_psi)}};
  }

  template <int Dim, class T>
  [[gnu::always_inline]] PlasticStep<T> operator()(SymTensor<Dim, T>& stress, T& gap,
                                                   const T& room) const {
    const auto of = [](Real value) { return number<T>(value); };
    const YieldSurface<decltype(of(0.0))> numbers = {of(surface.q), of(surface.k),
                                                     of(surface.cut_off), of(surface.bulk_q_psi),
                                                     of(surface.inv_hardness)};
    return return_to<Dim, T>(numbers, moduli, stress, gap, room);
  }

  /// The same with Opening::forgotten.
  template <int Dim, class T> PlasticStep<T> operator()(SymTensor<Dim, T>& stress) const {
    T gap = 0.0F;
    return operator()<Dim, T>(stress, gap, T(0.0F));
  }
};

} // namespace scarp
