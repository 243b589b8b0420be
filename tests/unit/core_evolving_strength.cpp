// Strength that changes with plastic strain and rate, against closed forms.
//
// Throughout: K = 2, G = 1 MPa; tension positive.
#include "core/evolving_strength.hpp"
#include "core/stress_pass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace scarp;

namespace {

constexpr ElasticModuli moduli = {2e6, 1e6};
constexpr Real density = 2500.0;

DruckerPrager sand() {
  DruckerPrager law;
  law.cohesion = 100.0;
  law.friction_angle = 30.0;
  return law;
}

EvolvingStrengthUpdate update_of(const DruckerPrager& law) {
  return EvolvingStrengthUpdate::from(law, moduli, density);
}

Real mean_of(const SymTensor<2>& stress) { return trace<2, Real>(stress) / 3.0; }

/// sqrt(J2) of a stress whose normal components hardly differ.
Real shear_of(const SymTensor<2>& stress) {
  Real J2 = stress[3] * stress[3];
  for (std::size_t i = 0; i < 3; ++i) J2 += 0.5 * std::pow(stress[i] - mean_of(stress), 2);
  return std::sqrt(J2);
}

struct Sheared {
  SymTensor<2> stress;
  Real plastic_strain = 0.0;
  Real dissipation = 0.0;
};

/// Shear without rotation (grad v symmetric) from a pressure, at a rate of engineering shear.
Sheared shear(const EvolvingStrengthUpdate& law, Real pressure, Real rate, Real dt, int steps) {
  Sheared point{{-pressure, -pressure, -pressure, 0.0}};
  const Mat<2> grad_v = {{{0.0, 0.5 * rate}, {0.5 * rate, 0.0}}};
  for (int k = 0; k < steps; ++k) {
    const PlasticStep<> plastic =
        update_stress<2>(point.stress, grad_v, dt, moduli, law.in_step(point.plastic_strain, dt));
    point.plastic_strain += plastic.strain;
    point.dissipation += plastic.dissipation;
  }
  return point;
}

} // namespace

/// At the peak strain and before the material is that without softening, at the residual strain and
/// beyond that of the residual values, halfway between them the mean of the cones.
TEST(EvolvingStrength, GoesLinearlyFromInitialToResidualCone) {
  DruckerPrager law = sand();
  law.dilation_angle = 10.0;
  law.residual = {.cohesion = 20.0,
                  .friction_angle = 20.0,
                  .dilation_angle = 0.0,
                  .peak_strain = 0.1,
                  .residual_strain = 0.3};
  DruckerPrager weak = sand();
  weak.cohesion = 20.0;
  weak.friction_angle = 20.0;
  const auto first = DruckerPragerUpdate::from(law, moduli).surface;
  const auto last = DruckerPragerUpdate::from(weak, moduli).surface;
  const auto expect = [&](Real strain, Real a) {
    const auto now = update_of(law).in_step(strain, 1e-3).surface;
    const auto between = [a](Real from, Real to) { return from + a * (to - from); };
    EXPECT_NEAR(now.q, between(first.q, last.q), 1e-14) << strain;
    EXPECT_NEAR(now.k, between(first.k, last.k), 1e-11) << strain;
    EXPECT_NEAR(now.bulk_q_psi, between(first.bulk_q_psi, 0.0), 1e-8) << strain;
    EXPECT_NEAR(now.cut_off, now.k / now.q, 1e-10) << "the apex moves as well";
  };
  expect(0.0, 0.0);
  expect(0.1, 0.0);
  expect(0.2, 0.5);
  expect(0.3, 1.0);
  expect(2.0, 1.0);
}

TEST(EvolvingStrength, ResidualValuesNotGivenStay) {
  DruckerPrager law = sand();
  law.residual.friction_angle = 20.0;
  law.residual.residual_strain = 0.2;
  const auto now = update_of(law).in_step(1.0, 1e-3).surface;
  DruckerPrager weak = sand();
  weak.friction_angle = 20.0; // k depends on the angle as well
  EXPECT_NEAR(now.q, DruckerPragerUpdate::from(weak, moduli).surface.q, 1e-14);
  EXPECT_NEAR(now.k, DruckerPragerUpdate::from(weak, moduli).surface.k, 1e-11);
  EXPECT_EQ(now.bulk_q_psi, 0.0);
}

/// Dilation makes d e_v = sqrt(3) q_psi d e of plastic volume.  At constant volume the material is
/// compressed by as much: with q_psi falling linearly to 0 at e_1, by K sqrt(3) q_psi e_1 / 2 of
/// pressure in all, however far the shear goes on.
TEST(EvolvingStrength, DilatancyEndsInACriticalState) {
  DruckerPrager law = sand();
  law.dilation_angle = 10.0;
  law.residual.dilation_angle = 0.0;
  law.residual.residual_strain = 0.02;
  const Real q_psi = cone_of(law.cone, law.dilation_angle, 0.0)[0];
  const Real grown = moduli.bulk * std::sqrt(3.0) * q_psi * 0.01;
  const auto update = update_of(law);
  const Sheared done = shear(update, 1000.0, 1.0, 1e-4, 2000);
  ASSERT_GT(done.plastic_strain, 0.05);
  // One step's plastic strain (6e-5) of the explicit state, out of 0.02.
  EXPECT_NEAR(-mean_of(done.stress), 1000.0 + grown, 0.01 * grown);
  EXPECT_NEAR(mean_of(shear(update, 1000.0, 1.0, 1e-4, 4000).stress), mean_of(done.stress), 1e-6);
}

/// tau = k + q p + b d sqrt(rho p) gamma', whatever the step: with zero dilation pressure stays,
/// and in steady shear all of the rate is plastic.
TEST(EvolvingStrength, SteadyShearGivesTheInertialLaw) {
  DruckerPrager law = sand();
  law.rate_strengthening = 1.2;
  law.grain_diameter = 0.002;
  const auto [q, k] = cone_of(law.cone, law.friction_angle, law.cohesion);
  for (const Real rate : {1.0, 100.0})
    for (const Real pressure : {500.0, 5000.0})
      for (const Real dt : {1e-6, 1e-4}) {
        const Real gamma = 0.5; // far beyond the elastic (k + q p) / G
        const int steps = static_cast<int>(gamma / (rate * dt));
        const Sheared done = shear(update_of(law), pressure, rate, dt, steps);
        const Real inertial = 0.002 * rate * std::sqrt(density / pressure);
        const Real expected = k + (q + 1.2 * inertial) * pressure;
        EXPECT_NEAR(shear_of(done.stress), expected, 1e-9 * pressure) << rate << " " << dt;
        EXPECT_NEAR(mean_of(done.stress), -pressure, 1e-9 * pressure);
      }
}

/// tau = k + (q + b I / (1 + b I / l)) p.
TEST(EvolvingStrength, SteadyShearGivesTheLimitedLaw) {
  DruckerPrager law = sand();
  law.rate_strengthening = 0.7;
  law.rate_strengthening_limit = 0.28;
  law.grain_diameter = 0.002;
  const auto [q, k] = cone_of(law.cone, law.friction_angle, law.cohesion);
  for (const Real rate : {1.0, 100.0, 1e4}) // I = 0.004 to 45
    for (const Real pressure : {500.0, 5000.0})
      for (const Real dt : {1e-6, 1e-4}) {
        const int steps = std::max(10, static_cast<int>(0.5 / (rate * dt)));
        const Sheared done = shear(update_of(law), pressure, rate, dt, steps);
        const Real inertial = 0.7 * 0.002 * rate * std::sqrt(density / pressure);
        const Real expected = k + (q + inertial / (1.0 + inertial / 0.28)) * pressure;
        EXPECT_NEAR(shear_of(done.stress), expected, 1e-9 * pressure) << rate << " " << dt;
      }
}

/// What is beyond the cone is shared out exactly, whatever of it counts: e from 1e-6 to 1e6 Pa at
/// pressures down to none, with a limit, without, and with dilation (a > 1).
TEST(EvolvingStrength, SharesOutWhatIsBeyondTheCone) {
  const auto check = [](auto zero, Real tolerance) {
    using T = decltype(zero);
    for (const Real limit : {0.28, 1e-3, std::numeric_limits<Real>::infinity()})
      for (const Real resistance : {0.0, 1e-4, 0.1, 10.0})
        for (const Real pressure : {-50.0, 0.0, 1e-3, 1.0, 1e5})
          for (const Real a : {1.0, 1.5})
            for (Real e = 1e-6; e < 2e6; e *= 10.0) {
              const EvolvingStrengthUpdate::Rate<T> rate = {
                  static_cast<T>(resistance), static_cast<T>(1.0 / limit), static_cast<T>(1e6)};
              const Real s =
                  rate.slip(static_cast<T>(e), static_cast<T>(a), static_cast<T>(-pressure));
              const Real p = std::max(pressure, Real(1e-12F) * 1e6), r = resistance * std::sqrt(p);
              EXPECT_NEAR(a * s + r * s / (1.0 + r * s / (limit * p)), e, tolerance * e)
                  << limit << ' ' << resistance << ' ' << pressure << ' ' << a;
            }
  };
  check(0.0, 1e-12);
  check(0.0F, 2e-5);
}

/// Zero rate of shear dissipates nothing more; what is dissipated is tau gamma' when steady.
TEST(EvolvingStrength, DissipatesWhatItResists) {
  DruckerPrager law = sand();
  law.rate_strengthening = 1.0;
  law.grain_diameter = 0.01;
  const auto update = update_of(law);
  const Real rate = 10.0, dt = 1e-5;
  const Sheared before = shear(update, 1000.0, rate, dt, 2000);
  const Sheared after = shear(update, 1000.0, rate, dt, 2001);
  EXPECT_NEAR(after.dissipation - before.dissipation, shear_of(after.stress) * rate * dt,
              1e-9 * shear_of(after.stress) * rate * dt);
}

/// With an infinite step rate does not count, and without strengthening the law is the plain one.
TEST(EvolvingStrength, IsThePlainLawWhereNothingEvolves) {
  DruckerPrager law = sand();
  law.dilation_angle = 5.0;
  const auto plain = DruckerPragerUpdate::from(law, moduli);
  law.rate_strengthening = 1.0;
  law.grain_diameter = 0.01;
  const auto still = update_of(law).in_step(0.0, std::numeric_limits<Real>::infinity());
  for (const Real mean : {-3000.0, -100.0, 50.0, 400.0}) {
    SymTensor<2> a = {mean - 100.0, mean + 100.0, mean, 900.0}, b = a;
    Real gap_a = 0.0, gap_b = 0.0;
    const PlasticStep<> of_plain = plain.operator()<2, Real>(a, gap_a, 0.5);
    const PlasticStep<> of_still = still.operator()<2, Real>(b, gap_b, 0.5);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-10) << mean;
    EXPECT_NEAR(of_plain.strain, of_still.strain, 1e-15);
    EXPECT_NEAR(gap_a, gap_b, 1e-15);
  }
}
