// The Drucker-Prager return against paths worked out by hand.
//
// Throughout: tension positive, sigma_m = tr(sigma)/3, tau = sqrt(J2), f = tau + q sigma_m - k.
// Moduli K = 3 and G = 2 (Pa) unless a test says otherwise, so the numbers stay readable.  With the
// tangent of the friction angle 3/4, sin = 0.6 and cos = 0.8.
#include "core/drucker_prager.hpp"
#include "core/stress_pass.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace scarp;
using scarp::test::Random;

namespace {

const double infinity = std::numeric_limits<double>::infinity();
const double root3 = std::sqrt(3.0);
const double degrees_345 = std::atan(0.75) * 180.0 / 3.14159265358979323846;
constexpr ElasticModuli moduli = {3.0, 2.0};

template <int Dim> Real mean_of(const SymTensor<Dim>& stress) { return trace<Dim>(stress) / 3.0; }

template <int Dim> Real tau_of(const SymTensor<Dim>& stress) {
  const Real mean = mean_of<Dim>(stress);
  Real J2 = 0.0;
  for (std::size_t i = 0; i < stress.size(); ++i)
    J2 += i < 3 ? 0.5 * (stress[i] - mean) * (stress[i] - mean) : stress[i] * stress[i];
  return std::sqrt(J2);
}

/// Mean stress and pure shear: tau is the shear stress.
SymTensor<2> shear(Real mean, Real tau) { return {mean, mean, mean, tau}; }

/// a : b
template <int Dim> Real contract(const SymTensor<Dim>& a, const SymTensor<Dim>& b) {
  Real total = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) total += (i < 3 ? 1.0 : 2.0) * a[i] * b[i];
  return total;
}

/// Strain of an elastic stress: s / 2G + sigma_m / 3K.
template <int Dim> SymTensor<Dim> strain_of(const SymTensor<Dim>& stress, const ElasticModuli& of) {
  const Real mean = mean_of<Dim>(stress);
  SymTensor<Dim> strain;
  for (std::size_t i = 0; i < stress.size(); ++i)
    strain[i] = i < 3 ? (stress[i] - mean) / (2.0 * of.shear) + mean / (3.0 * of.bulk)
                      : stress[i] / (2.0 * of.shear);
  return strain;
}

/// The law with given q_phi, k_phi, q_psi, by way of the plane-strain cone:
/// q = 3 t / sqrt(9 + 12 t^2) means t = 3 q / sqrt(9 - 12 q^2), and then
/// c = k sqrt(9 + 12 t^2) / 3.
DruckerPragerUpdate law_of(double q_phi, double k_phi, double q_psi, double sigma_t) {
  const auto tangent = [](double q) { return 3.0 * q / std::sqrt(9.0 - 12.0 * q * q); };
  const auto degrees = [](double t) { return std::atan(t) * 180.0 / 3.14159265358979323846; };
  DruckerPrager law;
  law.cone = Cone::plane_strain;
  law.friction_angle = degrees(tangent(q_phi));
  law.dilation_angle = degrees(tangent(q_psi));
  law.cohesion = k_phi * std::sqrt(9.0 + 12.0 * tangent(q_phi) * tangent(q_phi)) / 3.0;
  law.tension_cutoff = sigma_t;
  return DruckerPragerUpdate::from(law, moduli);
}

/// f = tau + sigma_m / 2 - 1, no dilation, no cut-off below the apex at sigma_m = 2.
const DruckerPragerUpdate simple = law_of(0.5, 1.0, 0.0, infinity);

} // namespace

/// E = 2.6, nu = 0.3: K = E / (3 (1 - 2 nu)) = 2.6 / 1.2, G = E / (2 (1 + nu)) = 1, and the modulus
/// of uniaxial strain E (1 - nu) / ((1 + nu)(1 - 2 nu)) = 2.6 * 0.7 / (1.3 * 0.4) = 3.5.
TEST(ElasticModuli, FromYoungAndPoisson) {
  const ElasticModuli from = ElasticModuli::from(2.6, 0.3);
  EXPECT_NEAR(from.bulk, 2.6 / 1.2, 1e-14);
  EXPECT_NEAR(from.shear, 1.0, 1e-14);
  EXPECT_NEAR(from.p_wave(), 3.5, 1e-14);
}

/// q = 6 sin / (sqrt(3) (3 +- sin)), k = 6 c cos / (sqrt(3) (3 +- sin)) with sin = 0.6, cos = 0.8:
///   '+': q = 3.6 / (3.6 sqrt 3) = 1 / sqrt 3,  k = 4.8 c / (3.6 sqrt 3) = 4 c / (3 sqrt 3)
///   '-': q = 3.6 / (2.4 sqrt 3) = sqrt 3 / 2,  k = 4.8 c / (2.4 sqrt 3) = 2 c / sqrt 3
/// plane strain: q = 3 t / sqrt(9 + 12 t^2) = 2.25 / sqrt 15.75,  k = 3 c / sqrt 15.75.
TEST(DruckerPrager, ConesOfAThreeFourFiveAngle) {
  DruckerPrager law;
  law.cohesion = 9.0;
  law.friction_angle = degrees_345;
  law.dilation_angle = degrees_345;
  struct Case {
    Cone cone;
    double q, k;
  };
  for (const auto& [cone, q, k] :
       {Case{Cone::inscribed, 1.0 / root3, 12.0 / root3},
        Case{Cone::circumscribed, 0.5 * root3, 18.0 / root3},
        Case{Cone::plane_strain, 2.25 / std::sqrt(15.75), 27.0 / std::sqrt(15.75)}}) {
    law.cone = cone;
    const auto update = DruckerPragerUpdate::from(law, moduli);
    EXPECT_NEAR(update.surface.q, q, 1e-14);
    EXPECT_NEAR(update.surface.k, k, 1e-13);
    EXPECT_NEAR(update.surface.bulk_q_psi, moduli.bulk * q, 1e-13); // psi = phi: the same slope
    EXPECT_NEAR(update.surface.cut_off, k / q, 1e-12) << "no cut-off means the apex";
  }
}

/// The cones touch Mohr-Coulomb  s1 - s3 = 2 c cos - (s1 + s3) sin  (s1 >= s2 >= s3) on its edges:
/// circumscribed where s1 = s2 (triaxial compression), inscribed where s2 = s3 (triaxial
/// extension). With s3 = -10 and c = 1:  s1 (1 + sin) = 2 c cos + s3 (1 - sin), so s1 = (1.6 - 4)
/// / 1.6 = -1.5.
TEST(DruckerPrager, ConesTouchMohrCoulombOnItsEdges) {
  DruckerPrager law;
  law.cohesion = 1.0;
  law.friction_angle = degrees_345;
  const auto f = [&](Cone cone, const SymTensor<3>& stress) {
    law.cone = cone;
    const auto update = DruckerPragerUpdate::from(law, moduli);
    return tau_of<3>(stress) + update.surface.q * mean_of<3>(stress) - update.surface.k;
  };
  const SymTensor<3> compression = {-1.5, -1.5, -10.0, 0.0, 0.0, 0.0};
  const SymTensor<3> extension = {-1.5, -10.0, -10.0, 0.0, 0.0, 0.0};
  EXPECT_NEAR(f(Cone::circumscribed, compression), 0.0, 1e-13);
  EXPECT_NEAR(f(Cone::inscribed, extension), 0.0, 1e-13);
  EXPECT_GT(f(Cone::inscribed, compression), 0.5) << "the inscribed cone yields first";
  EXPECT_LT(f(Cone::circumscribed, extension), -0.5) << "the circumscribed cone yields last";
}

TEST(DruckerPrager, CutOffIsBoundedByTheApex) {
  DruckerPrager law;
  law.cohesion = 9.0;
  law.friction_angle = degrees_345; // inscribed: apex at k/q = 12
  law.tension_cutoff = 5.0;
  EXPECT_EQ(DruckerPragerUpdate::from(law, moduli).surface.cut_off, 5.0);
  law.tension_cutoff = 13.0;
  EXPECT_NEAR(DruckerPragerUpdate::from(law, moduli).surface.cut_off, 12.0, 1e-12);
  law.friction_angle = 0.0; // a cylinder (von Mises, k = 2 c / sqrt 3) has no apex
  law.tension_cutoff = infinity;
  const auto cylinder = DruckerPragerUpdate::from(law, moduli);
  EXPECT_EQ(cylinder.surface.cut_off, infinity);
  EXPECT_NEAR(cylinder.surface.k, 18.0 / root3, 1e-13);
}

TEST(DruckerPrager, LeavesElasticStressAlone) {
  for (const SymTensor<2>& before :
       {shear(-1.0, 1.49), SymTensor<2>{-3.0, -1.0, -2.0, 0.25}, SymTensor<2>{}}) {
    SymTensor<2> stress = before;
    const auto step = simple.operator()<2>(stress);
    EXPECT_EQ(stress, before);
    EXPECT_EQ(step.strain, 0.0);
    EXPECT_EQ(step.dissipation, 0.0);
  }
  SymTensor<2> stress = shear(-1.0, 3.0);
  simple.operator()<2>(stress);
  stress[3] *= 0.9; // elastic unloading from the yield surface
  const SymTensor<2> unloaded = stress;
  EXPECT_EQ(simple.operator()<2>(stress).strain, 0.0);
  EXPECT_EQ(stress, unloaded);
}

/// Trial sigma_m = -1, tau = 3: f = 3 - 0.5 - 1 = 1.5.  No dilation: sigma_m stays, tau = 1 + 0.5
/// = 1.5, so the shear stress halves.  gamma_p = (3 - 1.5) / G = 0.75; its equivalent strain is
/// gamma_p / sqrt 3; the dissipation is tau gamma_p = 1.5 * 0.75 = 1.125.
TEST(DruckerPrager, ShearReturnWithoutDilation) {
  SymTensor<2> stress = shear(-1.0, 3.0);
  const auto step = simple.operator()<2>(stress);
  EXPECT_NEAR(stress[3], 1.5, 1e-14);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(stress[i], -1.0, 1e-14);
  EXPECT_NEAR(step.strain, 0.75 / root3, 1e-14);
  EXPECT_NEAR(step.dissipation, 1.125, 1e-14);
}

/// Trial (-1 + 4, -1 - 4, -1, 0), sigma_m = -1, tau = 4: tau = 1.5 after the return, so the
/// deviator (4, -4, 0) shrinks to 3/8: (1.5, -1.5, 0).
TEST(DruckerPrager, ReturnKeepsTheDirectionOfTheDeviator) {
  SymTensor<3> stress = {3.0, -5.0, -1.0, 0.0, 0.0, 0.0};
  simple.operator()<3>(stress);
  const SymTensor<3> expected = {0.5, -2.5, -1.0, 0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(stress[i], expected[i], 1e-14);
}

/// q_psi = 0.25, trial sigma_m = -1, tau = 3, f = 1.5:
///   lambda = f / (G + K q q_psi) = 1.5 / (2 + 3 * 0.5 * 0.25) = 1.5 / 2.375 = 12/19
///   sigma_m = -1 - K q_psi lambda = -1 - 0.75 * 12/19 = -28/19,  tau = 3 - G lambda = 33/19
/// (check: 33/19 - 14/19 - 1 = 0).  Flow: volumetric strain (sigma_m,trial - sigma_m)/K = 3/19 is
/// q_psi times the plastic shear strain (3 - tau)/G = 12/19.
/// Dissipation: tau lambda + sigma_m q_psi lambda = 12/19 (33 - 7)/19 = 312/361.
TEST(DruckerPrager, DilatantFlow) {
  const DruckerPragerUpdate law = law_of(0.5, 1.0, 0.25, infinity);
  SymTensor<2> stress = shear(-1.0, 3.0);
  const auto step = law.operator()<2>(stress);
  EXPECT_NEAR(stress[3], 33.0 / 19.0, 1e-14);
  EXPECT_NEAR(mean_of<2>(stress), -28.0 / 19.0, 1e-14);
  EXPECT_NEAR(step.strain, 12.0 / 19.0 / root3, 1e-14);
  EXPECT_NEAR(step.dissipation, 312.0 / 361.0, 1e-14);
}

/// Cut-off at 0.5, trial sigma_m = 0.9, tau = 0.2: f = 0.2 + 0.45 - 1 < 0, so only the cut-off
/// acts.  tau stays; the volume opens by (0.9 - 0.5)/3 and dissipates 0.5 * 0.4/3;
/// no deviatoric plastic strain.
TEST(DruckerPrager, CutOffAlone) {
  const DruckerPragerUpdate law = law_of(0.5, 1.0, 0.0, 0.5);
  SymTensor<2> stress = shear(0.9, 0.2);
  const auto step = law.operator()<2>(stress);
  EXPECT_NEAR(mean_of<2>(stress), 0.5, 1e-14);
  EXPECT_NEAR(stress[3], 0.2, 1e-14);
  EXPECT_EQ(step.strain, 0.0);
  EXPECT_NEAR(step.dissipation, 0.2 / 3.0, 1e-14);
}

/// Cut-off at 0.5 (where the cone stands at tau = 0.75), trial sigma_m = 1.5, tau = 0.6: the cone
/// is broken too (0.6 + 0.75 - 1 > 0), but the trial lies under the edge,
/// so again only the cut-off acts.
TEST(DruckerPrager, CutOffAloneBesideTheCone) {
  const DruckerPragerUpdate law = law_of(0.5, 1.0, 0.0, 0.5);
  SymTensor<2> stress = shear(1.5, 0.6);
  const auto step = law.operator()<2>(stress);
  EXPECT_NEAR(mean_of<2>(stress), 0.5, 1e-14);
  EXPECT_NEAR(stress[3], 0.6, 1e-14);
  EXPECT_EQ(step.strain, 0.0);
}

/// Cut-off at 0.5, trial sigma_m = 1.5, tau = 2.75: both surfaces act, stress at their edge (0.5,
/// 0.75). Plastic shear (2.75 - 0.75)/2 = 1, volume 1/3; dissipation 0.75 * 1 + 0.5 / 3.
TEST(DruckerPrager, EdgeOfConeAndCutOff) {
  const DruckerPragerUpdate law = law_of(0.5, 1.0, 0.0, 0.5);
  SymTensor<2> stress = shear(1.5, 2.75);
  const auto step = law.operator()<2>(stress);
  EXPECT_NEAR(mean_of<2>(stress), 0.5, 1e-14);
  EXPECT_NEAR(stress[3], 0.75, 1e-14);
  EXPECT_NEAR(step.strain, 1.0 / root3, 1e-14);
  EXPECT_NEAR(step.dissipation, 0.75 + 0.5 / 3.0, 1e-14);
}

/// What opens without shear, and a dilation angle: all of it is gap, and it closes without
/// pressure.
TEST(DruckerPrager, OpeningWithoutShearDoesNotDilate) {
  const DruckerPragerUpdate law = law_of(0.5, 0.0, 0.5, infinity); // the apex is at 0
  Real gap = 0.0;
  SymTensor<2> stress = {};
  const auto strain = [&](Real e) {
    for (std::size_t i = 0; i < 3; ++i) stress[i] += moduli.bulk * e;
    return law.operator()<2, Real>(stress, gap, infinity);
  };
  const PlasticStep<> opened = strain(0.1);
  EXPECT_NEAR(gap, 0.1, 1e-15);
  EXPECT_EQ(opened.strain, 0.0);
  strain(-0.06);
  EXPECT_NEAR(gap, 0.04, 1e-15);
  EXPECT_NEAR(stress[0], 0.0, 1e-15);
  strain(-0.05);
  EXPECT_NEAR(gap, 0.0, 1e-15);
  EXPECT_NEAR(stress[0], -0.01 * moduli.bulk, 1e-14);
}

/// With dilation the return to the cone alone may end below the cut-off: then the cut-off rests.
/// q_psi = 0.5, trial sigma_m = 0.6, tau = 3.7 (f = 3.7 + 0.3 - 1 = 3):
/// lambda = 3 / (2 + 0.75) = 12/11, sigma_m = 0.6 - 1.5 * 12/11 = -11.4/11 < 0.5,
/// tau = 3.7 - 24/11 = 16.7/11.
TEST(DruckerPrager, DilationBringsTheStressBelowTheCutOff) {
  const DruckerPragerUpdate law = law_of(0.5, 1.0, 0.5, 0.5);
  SymTensor<2> stress = shear(0.6, 3.7);
  law.operator()<2>(stress);
  EXPECT_NEAR(mean_of<2>(stress), -11.4 / 11.0, 1e-14);
  EXPECT_NEAR(stress[3], 16.7 / 11.0, 1e-14);
}

/// The apex of f = tau + sigma_m/2 - 1 is at sigma_m = 2: trial sigma_m = 5, tau = 1 returns there.
/// Dissipation: 2 * (5 - 2)/3 = 2; equivalent plastic strain 1 / (2 sqrt 3).
TEST(DruckerPrager, Apex) {
  SymTensor<2> stress = shear(5.0, 1.0);
  const auto step = simple.operator()<2>(stress);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(stress[i], 2.0, 1e-14);
  EXPECT_NEAR(stress[3], 0.0, 1e-14);
  EXPECT_NEAR(step.strain, 0.5 / root3, 1e-14);
  EXPECT_NEAR(step.dissipation, 2.0, 1e-14);
}

TEST(DruckerPrager, CohesionlessTensionGivesNoStress) {
  DruckerPrager sand;
  sand.friction_angle = 30.0;
  const auto law = DruckerPragerUpdate::from(sand, ElasticModuli::from(1e6, 0.3));
  EXPECT_EQ(law.surface.cut_off, 0.0);
  Random random(7);
  for (int sample = 0; sample < 100; ++sample) {
    SymTensor<3> stress;
    for (Real& value : stress) value = random.between(-1e3, 1e3);
    const Real lift = random.between(0.0, 1e3) - mean_of<3>(stress);
    for (std::size_t i = 0; i < 3; ++i) stress[i] += lift; // now the mean is tensile
    const auto step = law.operator()<3>(stress);
    for (const Real value : stress) EXPECT_EQ(value, 0.0);
    EXPECT_EQ(step.dissipation, 0.0);
  }
}

/// Random laws and random trial stresses.  What must hold of a return to two surfaces (Koiter) with
/// plastic multipliers l1 = (tau_trial - tau)/G of the cone and l2 = tr e_p - q_psi l1 of the
/// cut-off:
///   admissible: f <= 0 and sigma_m <= sigma_t;  l1 >= 0, l2 >= 0;  l1 > 0 only on the cone, l2 > 0
///   only on the cut-off.  (At the apex l1 is at least the slip, which serves.)
/// The plastic work is stress : e_p with e_p = C^-1 (trial - stress),
/// and never negative for psi <= phi.
template <int Dim> void sweep(std::uint64_t seed) {
  Random random(seed);
  int cone_only = 0, cut_only = 0, edge = 0, untouched = 0;
  for (int sample = 0; sample < 20000; ++sample) {
    DruckerPrager material;
    material.cohesion = sample % 3 == 0 ? 0.0 : random.between(0.0, 2.0);
    material.friction_angle = random.between(0.0, 60.0);
    material.dilation_angle = sample % 2 == 0 ? 0.0 : random.between(0.0, material.friction_angle);
    material.cone =
        std::array{Cone::inscribed, Cone::circumscribed,
                   Cone::plane_strain}[static_cast<std::size_t>(random.between(0.0, 3.0))];
    material.tension_cutoff = sample % 5 == 0 ? infinity : random.between(0.0, 2.0);
    const ElasticModuli of =
        ElasticModuli::from(random.between(1.0, 10.0), random.between(0.0, 0.49));
    const auto law = DruckerPragerUpdate::from(material, of);

    SymTensor<Dim> trial;
    const Real spread =
        sample % 4 == 0 ? 0.3 : 4.0; // small shear, so that the cut-off may act alone
    for (Real& value : trial) value = random.between(-spread, spread);
    const Real lift = random.between(-8.0, 4.0);
    for (std::size_t i = 0; i < 3; ++i) trial[i] += lift;

    SymTensor<Dim> stress = trial;
    const auto step = law.template operator()<Dim>(stress);
    const Real tau = tau_of<Dim>(stress);
    const Real mean = mean_of<Dim>(stress);
    const Real f = tau + law.surface.q * mean - law.surface.k;
    constexpr Real rounding = 1e-13; // of stresses and strains of about 10

    ASSERT_LE(f, rounding);
    ASSERT_LE(mean, law.surface.cut_off + rounding);
    const Real l1 = (tau_of<Dim>(trial) - tau) / of.shear;
    const Real l2 = (mean_of<Dim>(trial) - mean) / of.bulk - law.surface.bulk_q_psi / of.bulk * l1;
    ASSERT_GE(l1, -rounding);
    ASSERT_GE(l2, -rounding);
    if (l1 > 1e-9) {
      ASSERT_NEAR(f, 0.0, rounding);
    }
    if (l2 > 1e-9) {
      ASSERT_NEAR(mean, law.surface.cut_off, rounding);
    }
    ++(l1 > 1e-9 ? (l2 > 1e-9 ? edge : cone_only) : (l2 > 1e-9 ? cut_only : untouched));

    SymTensor<Dim> plastic = strain_of<Dim>(trial, of);
    const SymTensor<Dim> elastic = strain_of<Dim>(stress, of);
    for (std::size_t i = 0; i < plastic.size(); ++i) plastic[i] -= elastic[i];
    SymTensor<Dim> deviator = plastic;
    for (std::size_t i = 0; i < 3; ++i) deviator[i] -= mean_of<Dim>(plastic);
    ASSERT_NEAR(step.strain, std::sqrt(2.0 / 3.0 * contract<Dim>(deviator, deviator)), 1e-12);
    ASSERT_NEAR(step.dissipation, contract<Dim>(stress, plastic), 1e-11);
    ASSERT_GE(step.dissipation, -rounding);

    // A return is final: doing it again, just inside the surface, changes nothing.
    SymTensor<Dim> again = stress;
    ASSERT_NEAR(law.template operator()<Dim>(again).strain, 0.0, rounding);
    for (std::size_t i = 0; i < again.size(); ++i) ASSERT_NEAR(again[i], stress[i], rounding);
  }
  // The sweep has been everywhere.
  EXPECT_GT(untouched, 200);
  EXPECT_GT(cone_only, 200);
  EXPECT_GT(cut_only, 200);
  EXPECT_GT(edge, 200);
}

TEST(DruckerPrager, RandomReturnsAreKoitersSolution2d) { sweep<2>(1); }
TEST(DruckerPrager, RandomReturnsAreKoitersSolution3d) { sweep<3>(2); }

/// The plane-strain cone is Mohr-Coulomb in plane-strain flow with psi = phi.  Then no plastic
/// strain out of plane means s_yy = -2 q tau / 3, hence for the in-plane centre p and radius R
///   p = sigma_m + q tau / 3,  R = tau sqrt(1 - q^2/3),  so f = 0 reads
///   R = (k - q p) / sqrt(1 - q^2/3),
/// and with q = 3 t / sqrt(9 + 12 t^2), k = 3 c / sqrt(9 + 12 t^2): R = c cos(phi) - p sin(phi).
/// The strain path that keeps the stress where it is has (e1 + e3)/(e1 - e3) = sin(psi) = sin(phi).
TEST(DruckerPrager, PlaneStrainConeIsMohrCoulombInFlow) {
  DruckerPrager soil;
  soil.cohesion = 20e3;
  soil.friction_angle = soil.dilation_angle = degrees_345;
  soil.cone = Cone::plane_strain;
  const ElasticModuli of = ElasticModuli::from(70e6, 0.3);
  const auto law = DruckerPragerUpdate::from(soil, of);
  SymTensor<2> tau = {-100e3, -100e3, -100e3, 0.0};
  const Mat<2> rate = {{{0.5 * (0.6 + 1.0), 0.0}, {0.0, 0.5 * (0.6 - 1.0)}}}; // unit shear rate
  for (int step = 0; step < 20000; ++step) update_stress<2>(tau, rate, 1e-5, of, law);
  const Real p = 0.5 * (tau[0] + tau[1]);
  const Real R = 0.5 * (tau[0] - tau[1]);
  const Real mohr_coulomb = 20e3 * 0.8 - p * 0.6;
  EXPECT_GT(mohr_coulomb, 20e3) << "still under pressure";
  EXPECT_NEAR(R / mohr_coulomb, 1.0, 1e-10);

  // The inscribed cone in its own flow (psi = phi) is weaker: here q = 1/sqrt 3, so
  // R / tau = sqrt(8/9).
  soil.cone = Cone::inscribed;
  const auto weak = DruckerPragerUpdate::from(soil, of);
  tau = {-100e3, -100e3, -100e3, 0.0};
  const Real q_psi = weak.surface.bulk_q_psi / weak.moduli.bulk;
  const Real sin_flow = q_psi / std::sqrt(1.0 - q_psi * q_psi / 3.0);
  const Mat<2> weak_rate = {{{0.5 * (sin_flow + 1.0), 0.0}, {0.0, 0.5 * (sin_flow - 1.0)}}};
  for (int step = 0; step < 20000; ++step) update_stress<2>(tau, weak_rate, 1e-5, of, weak);
  EXPECT_NEAR(0.5 * (tau[0] - tau[1]),
              (weak.surface.k - weak.surface.q * 0.5 * (tau[0] + tau[1])) / std::sqrt(8.0 / 9.0),
              1e-10 * 100e3);
}
