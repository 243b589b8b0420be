// Stress, force and volume: one discrete energy.  Random points, all shape functions.
#include "tests/support/random_points.hpp"

#include <cmath>

using namespace scarp;
using namespace scarp::test;

namespace {

template <class Tested> class Forces : public RandomPoints<Tested> {
 protected:
  /// Gives the nodes random velocities and returns the power of the forces, W.
  double power_of_random_velocities() {
    double power = 0.0;
    auto& nodes = this->state.nodal.nodes;
    for (const int at : active_nodes(this->state))
      for (std::size_t i = 0; i < Tested::value; ++i) {
        nodes.v[i][at] = this->random.between(-1.0, 1.0);
        power += this->forces[i][static_cast<std::size_t>(at)] * nodes.v[i][at];
      }
    return power;
  }
};
TYPED_TEST_SUITE(Forces, Cases, CaseName);

/// The stress pass for elastic points of one material.
template <int Dim, class Shape>
void strain_points(State<Dim, Shape>& state, std::uint8_t material, const ElasticModuli& moduli,
                   Real dt) {
  stress_pass<Dim>(state, material, moduli, ElasticUpdate{}, false, dt);
}

} // namespace

/// The gradients of all shape functions add up to zero, so internal forces do.
TYPED_TEST(Forces, InternalForcesCancel) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  Vec<Dim> f = {};
  double size = 0.0;
  for (const int at : active_nodes(this->state))
    for (std::size_t i = 0; i < Dim; ++i) {
      f[i] += this->node(at).f[i];
      size += std::abs(this->node(at).f[i]);
    }
  EXPECT_GT(size, 100.0);
  for (std::size_t i = 0; i < Dim; ++i) EXPECT_NEAR(f[i], 0.0, 1e-15 * size);
}

/// Force and strain are adjoint: sum_I f_I . v_I = - sum_p V0 tau :
/// grad v for any nodal velocities.
TYPED_TEST(Forces, ForceIsAdjointToTheGradient) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  const double power = this->power_of_random_velocities();
  double stress_power = 0.0;
  const auto& points = this->state.particles;
  for (const std::size_t p : rows_of(points))
    for (int index = 0; index < this->state.grid.node_count; ++index) {
      Vec<Dim> dN;
      this->hat(index, p, &dN);
      if (dN == Vec<Dim>{}) continue;
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j)
          stress_power += points.V0[p] *
                          points.tau[component<Dim>(static_cast<int>(i), static_cast<int>(j))][p] *
                          this->node(index).v[i] * dN[j];
    }
  EXPECT_GT(std::abs(power), 1.0);
  EXPECT_NEAR(power, -stress_power, 1e-9 * std::abs(power)) << "gradients by differences";

  // The code's own gradient: with K = 1/3, G = 1/2 (nu = 0, E = 1) the stress increment of a point
  // is its strain increment d dt, from which the power follows again.  (The spin turns what stress
  // there is: start at 0.  It turns half of the increment too, which adds (W d - d W) dt^2 / 2:
  // even in dt, so that steps of dt and - dt differ by 2 d dt but for a part of dt^2, here 1e-16.)
  const auto tau = points.tau;
  const double e = 1e-8;
  const auto strain_during = [&](double time) {
    for (Column& column : this->state.particles.tau) std::fill(column.begin(), column.end(), 0.0);
    strain_points(this->state, 0, ElasticModuli{1.0 / 3.0, 0.5}, time);
    return points.tau;
  };
  const auto forth = strain_during(e), back = strain_during(-e);
  double strain_power = 0.0;
  for (const std::size_t p : rows_of(points))
    for (std::size_t i = 0; i < tau.size(); ++i)
      strain_power +=
          points.V0[p] * (i < 3 ? 1.0 : 2.0) * tau[i][p] * (forth[i][p] - back[i][p]) / (2.0 * e);
  EXPECT_NEAR(power, -strain_power, 1e-13 * std::abs(power));
}

/// - V0 tau . grad N is minus the derivative of the stored energy: let the nodes move by du, the
/// points' stresses follow, and sum_p V0 psi(tau) grows by - f . du in first order.
/// So it does with the volume rate averaged over cells, with the force that goes with it.
TYPED_TEST(Forces, ForceIsMinusTheGradientOfTheEnergy) {
  for (const bool averages : {false, true}) {
    this->state.averages_volume = averages;
    const ElasticModuli moduli = {2.0, 3.0};
    const auto energy = [&] { // psi = sigma_m^2 / 2K + s:s / 4G
      double total = 0.0;
      const auto& points = this->state.particles;
      for (const std::size_t p : rows_of(points)) {
        const double mean = (points.tau[0][p] + points.tau[1][p] + points.tau[2][p]) / 3.0;
        double s2 = 0.0;
        for (std::size_t i = 0; i < points.tau.size(); ++i) {
          const double s = points.tau[i][p] - (i < 3 ? mean : 0.0);
          s2 += (i < 3 ? 1.0 : 2.0) * s * s;
        }
        total += points.V0[p] * (0.5 * mean * mean / moduli.bulk + 0.25 * s2 / moduli.shear);
      }
      return total;
    };
    this->scatter_all();
    const double power = this->power_of_random_velocities();
    // A central difference of width 2 e: its error is of order e^2.
    const auto start = this->state.particles.tau;
    const double e = 1e-5;
    strain_points(this->state, 0, moduli, e);
    const double after = energy();
    this->state.particles.tau = start;
    strain_points(this->state, 0, moduli, -e);
    const double before = energy();
    EXPECT_GT(std::abs(power), 0.1);
    EXPECT_NEAR((after - before) / (2.0 * e), -power, 1e-6 * std::abs(power)) << averages;
    this->state.particles.tau = start;
  }
}

/// With cell averages all points of a cell have one volume rate, the mean of their own.
TYPED_TEST(Forces, CellAveragesOfTheVolumeRate) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  for (const int at : active_nodes(this->state))
    for (Column& v : this->state.nodal.nodes.v) v[at] = this->random.between(-1.0, 1.0);
  const auto& points = this->state.particles;
  const ElasticModuli moduli = {1.0, 1.0};
  strain_points(this->state, 0, moduli, 0.01);
  Column own = points.J; // as rates: the strain x of J = (2 + x)/(2 - x)
  for (Real& J : own) J = 2.0 * (J - 1.0) / (J + 1.0);
  std::fill(this->state.particles.J.begin(), this->state.particles.J.end(), 1.0);
  this->state.averages_volume = true;
  strain_points(this->state, 0, moduli, 0.01);
  for (const auto& cell : this->state.order.cells()) {
    const double mean = cell_mean(this->state, cell, [&](std::size_t p) { return own[p]; });
    for (std::size_t k = 0; k < cell.count; ++k)
      EXPECT_NEAR(points.J[cell.row(k)], (2.0 + mean) / (2.0 - mean), 1e-14);
  }
  static_assert(Dim == 2 || Dim == 3);
}

/// J' = J (2 + x)/(2 - x), exp(x) to second order, with x = dt div v, and nothing else touches J; a
/// uniform velocity strains nothing.
TYPED_TEST(Forces, VolumeFollowsTheDivergence) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  for (const int at : active_nodes(this->state)) {
    auto& nodes = this->state.nodal.nodes;
    for (std::size_t i = 0; i < Dim; ++i) // v = (0.3 x_0, 0.1 x_1, ...) + constant
      nodes.v[i][at] = 0.7 + (i == 0 ? 0.3 : 0.1) * this->place(at)[i];
  }
  const Real strain = 0.01 * (0.3 + 0.1 * (Dim - 1));
  const Real step = (2.0 + strain) / (2.0 - strain);
  strain_points(this->state, 0, ElasticModuli{1.0, 1.0}, 0.01);
  const auto& points = this->state.particles;
  for (const std::size_t p : rows_of(points)) EXPECT_NEAR(points.J[p], step, 1e-14);
  strain_points(this->state, 0, ElasticModuli{1.0, 1.0}, 0.01);
  for (const std::size_t p : rows_of(points)) EXPECT_NEAR(points.J[p], step * step, 1e-14);
  strain_points(this->state, 1, ElasticModuli{1.0, 1.0}, 0.01);
  for (const std::size_t p : rows_of(points))
    EXPECT_NEAR(points.J[p], step * step, 1e-14) << "of another material";
}
