// One material point through the stress update, against Mohr-Coulomb and elasticity by hand.
//
// Compression is negative; p is the confining pressure, K = (1 + sin phi)/(1 - sin phi).  Which
// cone meets Mohr-Coulomb where:
//   triaxial compression  circumscribed   -s_axial = K p + 2 c sqrt(K)
//   triaxial extension    inscribed       -s_axial = (p - 2 c sqrt(K)) / K
//   plane strain          plane_strain    -s_zz = K p + 2 c sqrt(K), associated: it flows without a
//                                         plastic strain across the plane at that stress only
//   apex                  all             s_m = c / tan(phi), no deviator
// Shear at zero dilation and constant volume: s_m stays, sqrt(J2) rises by G gamma up to
// k - q s_m, and the work beyond the elastic energy sqrt(J2)^2 / 2G is dissipated.
// Oedometer: s_xx = nu/(1 - nu) s_zz.
#include "apps/bench/cases.hpp"

#include "core/drucker_prager.hpp"
#include "core/stress_pass.hpp"

#include <cmath>
#include <numbers>

namespace scarp::bench {

namespace {

constexpr double cohesion = 5e3;    // Pa
constexpr double pressure = 100e3;  // Pa
constexpr double phi = 30.0;        // degrees
const double K = 3.0;               // (1 + 1/2)/(1 - 1/2)
const double root_K = std::sqrt(K); // -
constexpr int steps = 2000;
constexpr double strain_step = -1e-5;

using Stress = SymTensor<3>;

DruckerPragerUpdate law_of(Cone cone, double dilation, const ElasticModuli& moduli) {
  DruckerPrager law;
  law.cohesion = cohesion;
  law.friction_angle = phi;
  law.dilation_angle = dilation;
  law.cone = cone;
  return DruckerPragerUpdate::from(law, moduli);
}

Stress strained(Stress stress, const std::array<double, 3>& strain, const ElasticModuli& moduli,
                const DruckerPragerUpdate& law) {
  const Mat<3> gradient = {{{strain[0], 0, 0}, {0, strain[1], 0}, {0, 0, strain[2]}}};
  update_stress<3>(stress, gradient, 1.0, moduli, law);
  return stress;
}

/// Strain along z in steps; that along x, and along y with `radial`, such that the stress s_xx
/// stays
/// - p.  Adds (strain, -s_zz) to the curve.  Returns the last -s_zz.
double compress(Cone cone, double dilation, bool radial, double step, render::Curve& curve) {
  const ElasticModuli moduli = ElasticModuli::from(20e6, 0.3);
  const DruckerPragerUpdate law = law_of(cone, dilation, moduli);
  Stress stress = {-pressure, -pressure, -pressure, 0, 0, 0};
  double across = 0.3; // of the step, the strain along x; where it was is where to look first
  for (int i = 1; i <= steps; ++i) {
    const auto trial = [&](double part) {
      return strained(stress, {-part * step, radial ? -part * step : 0.0, step}, moduli, law);
    };
    double a = across, b = across + 1e-3;
    double fa = trial(a)[0] + pressure;
    for (int k = 0; k < 50 && a != b; ++k) { // secant
      const double fb = trial(b)[0] + pressure;
      if (fb == fa || std::abs(fb) < 1e-9 * pressure) break;
      const double next = b - fb * (b - a) / (fb - fa);
      a = b;
      fa = fb;
      b = next;
    }
    across = b;
    stress = trial(across);
    curve.x.push_back(-100.0 * i * step);
    curve.y.push_back(-1e-3 * stress[2]);
  }
  return -stress[2];
}

struct Shear {
  double strength;    ///< Pa, sqrt(J2)
  double dissipation; ///< J/m3
  double expected;    ///< J/m3
};

/// Pure shear in the plane at constant volume.
Shear shear_at_constant_volume() {
  const ElasticModuli moduli = ElasticModuli::from(20e6, 0.3);
  const DruckerPragerUpdate law = law_of(Cone::inscribed, 0.0, moduli);
  SymTensor<2> stress = {-pressure, -pressure, -pressure, 0.0};
  Shear shear = {};
  double work = 0.0, before = 0.0;
  for (int i = 0; i < steps; ++i) {
    const Mat<2> gradient = {{{-strain_step, 0}, {0, strain_step}}};
    shear.dissipation += update_stress<2>(stress, gradient, 1.0, moduli, law).dissipation;
    shear.strength = 0.5 * (stress[0] - stress[1]);
    work += -strain_step * (shear.strength + before); // trapezium of 2 sqrt(J2) d epsilon
    before = shear.strength;
  }
  shear.expected = work - 0.5 * shear.strength * shear.strength / moduli.shear;
  return shear;
}

} // namespace

CaseReport stress_paths_case(Effort) {
  CaseReport report;
  std::vector<render::Curve> curves(3);
  curves[0].label = "triaxial compression";
  curves[1].label = "triaxial extension";
  curves[2].label = "plane strain";
  const double strong = K * pressure + 2.0 * cohesion * root_K;
  const double weak = (pressure - 2.0 * cohesion * root_K) / K;
  constexpr double tight = 1e-6;
  const std::string coulomb = "Mohr-Coulomb, by hand in apps/bench/case_stress_paths.cpp";

  const double compression = compress(Cone::circumscribed, 0.0, true, strain_step, curves[0]);
  const double extension = compress(Cone::inscribed, 0.0, true, -strain_step, curves[1]);
  const double plane = compress(Cone::plane_strain, phi, false, 5.0 * strain_step, curves[2]);
  report.checks = {
      {"triaxial_compression", compression, strong, tight, Bound::relative, "Pa", coulomb,
       "circumscribed cone"},
      {"triaxial_extension", extension, weak, tight, Bound::relative, "Pa", coulomb,
       "inscribed cone"},
      {"plane_strain", plane, strong, tight, Bound::relative, "Pa", coulomb,
       "plane-strain cone, associated; approached while elastic strain across the plane dies out"}};

  const Shear shear = shear_at_constant_volume();
  const double s = std::sin(phi * std::numbers::pi / 180.0);
  const double c = std::cos(phi * std::numbers::pi / 180.0);
  const double below = std::numbers::sqrt3 * (3.0 + s);
  report.checks.push_back({"shear_strength", shear.strength,
                           6.0 * cohesion * c / below + 6.0 * s / below * pressure, tight,
                           Bound::relative, "Pa", "sqrt(J2) = k + q p, inscribed cone",
                           "constant volume, zero dilation"});
  // The step in which it yields is not a trapezium: a part of strain_step / elastic strain.
  report.checks.push_back({"shear_dissipation", shear.dissipation, shear.expected, 1e-4,
                           Bound::relative, "J/m³", "work less elastic energy"});

  constexpr double nu = 0.4; // at which the oedometer stays elastic
  const ElasticModuli stiff = ElasticModuli::from(20e6, nu);
  Stress oedometer = {};
  for (int i = 0; i < steps; ++i)
    oedometer =
        strained(oedometer, {0.0, 0.0, strain_step}, stiff, law_of(Cone::inscribed, 0.0, stiff));
  report.checks.push_back({"oedometer_K0", oedometer[0] / oedometer[2], nu / (1.0 - nu), 1e-12,
                           Bound::relative, "-", "elasticity: nu / (1 - nu)", "nu = 0.4"});

  Stress apex = {-1e3, -2e3, -1e3, 500.0, 0.0, 0.0};
  for (int i = 0; i < steps; ++i)
    apex = strained(apex, {-strain_step, -strain_step, -strain_step}, stiff,
                    law_of(Cone::inscribed, 0.0, stiff));
  const double deviator = std::abs(apex[0] - apex[1]) + std::abs(apex[3]);
  report.checks.push_back({"apex_mean_stress", (apex[0] + apex[1] + apex[2]) / 3.0,
                           cohesion * c / s, 1e-12, Bound::relative, "Pa", "c / tan(phi)"});
  report.checks.push_back({"apex_deviator", deviator, 0.0, 1e-9 * cohesion, Bound::absolute, "Pa",
                           "the apex is a point"});

  for (const double limit : {strong, weak})
    curves.push_back({.label = limit == weak ? "Mohr-Coulomb" : "",
                      .x = {-2.0, 4.0},
                      .y = {1e-3 * limit, 1e-3 * limit},
                      .colour = render::ink,
                      .line = render::LineKind::dotted});
  report.figure = {{curves,
                    {.x_name = "compressive strain",

                     .x_unit = "%",
                     .y_name = "axial pressure",
                     .y_unit = "kPa",
                     .x_limits = render::Limits{-2.0, 4.0}}}};
  report.caption = "A material point at a confining pressure of 100 kPa (phi = 30°, c = 5 kPa).";
  return report;
}

} // namespace scarp::bench
