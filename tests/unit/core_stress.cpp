#include "core/stress_pass.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace scarp;
using scarp::test::Random;

namespace {

constexpr double pi = 3.14159265358979323846;

/// tr(sigma), sigma : sigma and det(sigma).
template <int Dim> std::array<Real, 3> invariants(const SymTensor<Dim>& s) {
  Real square = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) square += (i < 3 ? 1.0 : 2.0) * s[i] * s[i];
  Real det;
  if constexpr (Dim == 2)
    det = s[2] * (s[0] * s[1] - s[3] * s[3]);
  else
    det = s[0] * (s[1] * s[2] - s[4] * s[4]) - s[3] * (s[3] * s[2] - s[4] * s[5]) +
          s[5] * (s[3] * s[4] - s[1] * s[5]);
  return {s[0] + s[1] + s[2], square, det};
}

template <int Dim>
void expect_near(const SymTensor<Dim>& a, const SymTensor<Dim>& b, double tolerance) {
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

/// The spin increment of which Hughes and Winget's rotation is by `angle`: (I - W/2)^-1 (I + W/2)
/// turns by 2 atan(w/2).
double spin_of(double angle) { return 2.0 * std::tan(0.5 * angle); }

constexpr ElasticModuli moduli = {5.0, 3.0};

} // namespace

/// A gap is at most ln(1/fraction), and what is more is forgotten, work at the cut-off included.
TEST(Gap, IsNoMoreThanItsRoom) {
  using Lanes = Pack<double>;
  const SymTensor<2, Lanes> tau = {Lanes(2.0), Lanes(2.0), Lanes(2.0), Lanes(0.0)};
  for (const double fraction : {0.01, 0.5, 0.9, 1.0, 1.2}) {
    const double room = std::max(-std::log(fraction), 0.0);
    for (const double before : {0.5 * room, room + 0.3}) {
      PlasticStep<Lanes> plastic;
      Lanes gap = before;
      bound_gap<2>(plastic, gap, Lanes(fraction), tau);
      EXPECT_NEAR(gap[0], std::min(before, room), 1e-15) << fraction;
      EXPECT_NEAR(plastic.forgotten[0], std::max(before - room, 0.0), 1e-15) << fraction;
      EXPECT_NEAR(plastic.dissipation[0], 2.0 * std::max(before - room, 0.0), 1e-15) << fraction;
    }
  }
}

TEST(Rotate, KeepsInvariants2d) {
  Random random(11);
  for (int sample = 0; sample < 1000; ++sample) {
    SymTensor<2> stress;
    for (Real& value : stress) value = random.between(-1.0, 1.0);
    const auto before = invariants<2>(stress);
    rotate<2>(stress, {random.between(-3.0, 3.0)});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(invariants<2>(stress)[i], before[i], 1e-14);
  }
}

TEST(Rotate, KeepsInvariants3d) {
  Random random(12);
  for (int sample = 0; sample < 1000; ++sample) {
    SymTensor<3> stress;
    for (Real& value : stress) value = random.between(-1.0, 1.0);
    const auto before = invariants<3>(stress);
    rotate<3>(stress,
              {random.between(-3.0, 3.0), random.between(-3.0, 3.0), random.between(-3.0, 3.0)});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(invariants<3>(stress)[i], before[i], 1e-13);
  }
}

/// W_xz = (dv_x/dz - dv_z/dx)/2 > 0 turns z towards x.  A stress along x goes with the body: after
/// 30 degrees, x has turned to (cos, -sin), so sigma = (cos^2, sin^2, -sin cos) in xx, zz, xz.
TEST(Rotate, TurnsTheWayTheSpinTurns2d) {
  SymTensor<2> stress = {1.0, 0.0, 0.0, 0.0};
  rotate<2>(stress, {spin_of(pi / 6.0)});
  expect_near<2>(stress, {0.75, 0.25, 0.0, -0.25 * std::sqrt(3.0)}, 1e-15);
}

TEST(Rotate, QuarterTurnInManySteps2d) {
  for (const int steps : {1, 7, 90}) {
    SymTensor<2> stress = {3.0, -2.0, 0.5, 0.7};
    for (int step = 0; step < steps; ++step) rotate<2>(stress, {spin_of(0.5 * pi / steps)});
    expect_near<2>(stress, {-2.0, 3.0, 0.5, -0.7}, 1e-13); // xx <-> zz, yy stays, xz changes sign
  }
}

/// A quarter turn about each axis swaps the two normal stresses across it and negates the shear
/// between them.  The spin W_ij > 0 turns j towards i, that is e_j -> e_i, e_i -> -e_j; the shears
/// with the axis k follow: s_ik (old j) and s_jk -> -(old i).
TEST(Rotate, QuarterTurnAboutEachAxis3d) {
  const SymTensor<3> start = {1.0, 2.0, 3.0, 0.4, 0.5, 0.6}; // xx yy zz xy yz xz
  struct Case {
    std::size_t spin; ///< of W_xy, W_yz, W_xz
    SymTensor<3> after;
  };
  for (const auto& [axis, after] : {
           Case{0, {2.0, 1.0, 3.0, -0.4, -0.6, 0.5}}, // about z: i = x, j = y: xz <- yz, yz <- -xz
           Case{1, {1.0, 3.0, 2.0, 0.6, -0.5, -0.4}}, // about x: i = y, j = z: xy <- xz, xz <- -xy
           Case{2, {3.0, 2.0, 1.0, 0.5, -0.4, -0.6}}, // about y: i = x, j = z: xy <- yz, yz <- -xy
       }) {
    for (const int steps : {1, 50}) {
      SymTensor<3> stress = start;
      std::array<Real, 3> spin = {};
      spin[axis] = spin_of(0.5 * pi / steps);
      for (int step = 0; step < steps; ++step) rotate<3>(stress, spin);
      expect_near<3>(stress, after, 1e-13);
    }
  }
}

/// The same turn about y in both dimensions: W_xz is component 0 of Dim 2 and 2 of Dim 3.
TEST(Rotate, AgreesBetweenDimensions) {
  SymTensor<2> plane = {1.0, -2.0, 3.0, 0.4};
  SymTensor<3> full = {1.0, 3.0, -2.0, 0.0, 0.0, 0.4};
  rotate<2>(plane, {0.37});
  rotate<3>(full, {0.0, 0.0, 0.37});
  expect_near<3>(full, {plane[0], plane[2], plane[1], 0.0, 0.0, plane[3]}, 1e-15);
}

/// The increment over a small step is the Jaumann rate W tau - tau W:
///   xx: 2 W_xz tau_xz,  zz: -2 W_xz tau_xz,  xz: W_xz (tau_zz - tau_xx).
TEST(Rotate, SmallTurnIsTheJaumannRate) {
  const SymTensor<2> start = {1.0, -2.0, 3.0, 0.4};
  SymTensor<2> stress = start;
  const Real w = 1e-6;
  rotate<2>(stress, {w});
  EXPECT_NEAR((stress[0] - start[0]) / w, 0.8, 1e-5);
  EXPECT_NEAR((stress[1] - start[1]) / w, -0.8, 1e-5);
  EXPECT_NEAR((stress[3] - start[3]) / w, -3.0, 1e-5);
}

/// K = 5, G = 3: along the strain K + 4/3 G = 9, across it K - 2/3 G = 3.
TEST(UpdateStress, UniaxialStrain) {
  const Real rate = 2.0, dt = 0.5e-3; // strain 1e-3
  for (std::size_t axis = 0; axis < 2; ++axis) {
    SymTensor<2> stress = {};
    Mat<2> grad_v = {};
    grad_v[axis][axis] = rate;
    update_stress<2>(stress, grad_v, dt, moduli, ElasticUpdate{});
    SymTensor<2> expected = {3e-3, 3e-3, 3e-3, 0.0};
    expected[axis] = 9e-3;
    expect_near<2>(stress, expected, 1e-17);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    SymTensor<3> stress = {};
    Mat<3> grad_v = {};
    grad_v[axis][axis] = rate;
    update_stress<3>(stress, grad_v, dt, moduli, ElasticUpdate{});
    SymTensor<3> expected = {3e-3, 3e-3, 3e-3, 0.0, 0.0, 0.0};
    expected[axis] = 9e-3;
    expect_near<3>(stress, expected, 1e-17);
  }
}

/// A shear strain gamma, d v_i / d x_j, in one step from no stress.  Half of G gamma is turned by
/// the angle a with tan(a/2) = gamma/4, j towards i (W_ij = gamma/2), half is not:
///   tau_ij = G gamma (cos(2a) + 1)/2 = G gamma cos(a)^2,
///   tau_ii = - tau_jj = G gamma sin(2a)/2 = G gamma sin(a) cos(a).
TEST(UpdateStress, SimpleShear) {
  const Real gamma = 1e-3;
  const Real angle = 2.0 * std::atan(0.25 * gamma);
  const Real shear = 3e-3 * std::cos(angle) * std::cos(angle);
  const Real normal = 3e-3 * std::sin(angle) * std::cos(angle);
  for (const auto& [i, j] : {std::array<std::size_t, 2>{0, 1}, std::array<std::size_t, 2>{1, 0}}) {
    SymTensor<2> stress = {};
    Mat<2> grad_v = {};
    grad_v[i][j] = gamma;
    update_stress<2>(stress, grad_v, 1.0, moduli, ElasticUpdate{});
    SymTensor<2> expected = {0.0, 0.0, 0.0, shear};
    expected[i] = normal;
    expected[j] = -normal;
    expect_near<2>(stress, expected, 1e-17);
  }
  const auto shear_place = [](std::size_t i, std::size_t j) -> std::size_t { // xy yz xz
    return i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
  };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == j) continue;
      SymTensor<3> stress = {};
      Mat<3> grad_v = {};
      grad_v[i][j] = gamma;
      update_stress<3>(stress, grad_v, 1.0, moduli, ElasticUpdate{});
      SymTensor<3> expected = {};
      expected[i] = normal;
      expected[j] = -normal;
      expected[shear_place(i, j)] = shear;
      expect_near<3>(stress, expected, 1e-17);
    }
}

/// Simple shear to gamma = 1 with the Jaumann rate (Dienes 1979, Acta Mechanica 32:217): the spin
/// is gamma'/2, so tau_xz = G sin(gamma), tau_xx = -tau_zz = G (1 - cos(gamma)).
/// In N steps of q = 1/N, each a turn by a = 2 atan(q/4), the trapezoidal sum of G q exp(2 a i k)
/// over k = 0 to N is known: with T = 2 a N = 1 - q^2/48 + ...,
///   tau_xz = G A sin(T), tau_xx = G A (1 - cos(T)),  A = q cot(a) / 2 = 1 - q^2/16,
/// an error of G q^2 (sin(1)/16 + cos(1)/48) = 0.0638 G q^2 in tau_xz, and a smaller one in tau_xx.
TEST(UpdateStress, LargeSimpleShearFollowsTheJaumannRate) {
  std::array<double, 2> error;
  for (std::size_t k = 0; k < 2; ++k) {
    const int steps = k == 0 ? 1000 : 2000;
    SymTensor<2> stress = {};
    const Mat<2> grad_v = {{{0.0, 1.0}, {0.0, 0.0}}};
    for (int step = 0; step < steps; ++step)
      update_stress<2>(stress, grad_v, 1.0 / steps, moduli, ElasticUpdate{});
    error[k] = std::max(std::abs(stress[3] - 3.0 * std::sin(1.0)),
                        std::abs(stress[0] - 3.0 * (1.0 - std::cos(1.0))));
    EXPECT_NEAR(stress[0], -stress[1], 1e-14);
    const double q = 1.0 / steps, T = 4.0 * steps * std::atan(0.25 * q);
    EXPECT_NEAR(stress[3], 3.0 * (1.0 - q * q / 16.0) * std::sin(T), 1e-12);
    EXPECT_NEAR(stress[0], 3.0 * (1.0 - q * q / 16.0) * (1.0 - std::cos(T)), 1e-12);
  }
  EXPECT_LT(error[1], 3.0 * 0.064 / (2000.0 * 2000.0));
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.001);
}

/// A rigid turn strains nothing: a full revolution gives the stress back.
TEST(UpdateStress, RigidRevolution) {
  const int steps = 400;
  const Mat<2> grad_v = {{{0.0, spin_of(2.0 * pi / steps)}, {-spin_of(2.0 * pi / steps), 0.0}}};
  const SymTensor<2> start = {3.0, -2.0, 0.5, 0.7};
  SymTensor<2> stress = start;
  for (int step = 0; step < steps; ++step)
    update_stress<2>(stress, grad_v, 1.0, moduli, ElasticUpdate{});
  expect_near<2>(stress, start, 1e-12);
}
