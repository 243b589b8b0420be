// Points to nodes and back, at random points with random state, for all shape functions.  Nodes are
// found and weighted here by the textbook's functions, not by the code's own.
#include "core/compiled_passes.hpp"
#include "core/lattice.hpp"
#include "tests/support/nodes.hpp"
#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

using namespace scarp;
using namespace scarp::test;

namespace {

/// The stress pass for elastic points of one material.
template <int Dim, class Shape>
void strain_points(State<Dim, Shape>& state, std::uint8_t material, const ElasticModuli& moduli,
                   Real dt) {
  stress_pass<Dim>(state, material, moduli, ElasticUpdate{}, false, dt);
}

/// max(0, 1 - |x|), and its integral from minus infinity.
double hat_function(double x) { return std::max(0.0, 1.0 - std::abs(x)); }
double hat_integral(double x) {
  const double y = std::clamp(x, -1.0, 1.0);
  return y < 0.0 ? 0.5 * (1.0 + y) * (1.0 + y) : 1.0 - 0.5 * (1.0 - y) * (1.0 - y);
}

/// One axis of n cells, x in cells: N of node k, and its place.
struct Linear {
  template <int Dim> using Shape = LinearShape<Dim>;
  static constexpr int nodes(int n) { return n + 1; }
  static double place(int k, int) { return k; }
  static double N(int k, double x, int) { return hat_function(x - k); }
};

/// The mean of the linear function over a point of half the cell, two points a cell; one layer of
/// nodes beyond each side.
struct Gimp {
  template <int Dim> using Shape = GimpShape<Dim>;
  static constexpr int nodes(int n) { return n + 3; }
  static double place(int k, int) { return k - 1; }
  static double N(int k, double x, int) {
    const double d = x - (k - 1), l = 0.25;
    return (hat_integral(d + l) - hat_integral(d - l)) / (2.0 * l);
  }
};

/// Cox and de Boor's recursion on the knots -2 -1 0 1 2 ...; Greville's places.
struct Spline {
  template <int Dim> using Shape = SplineShape<Dim>;
  static constexpr int nodes(int n) { return n + 2; }
  static double knot(int i) { return i - 2; }
  static double place(int k, int) { return 0.5 * (knot(k + 1) + knot(k + 2)); }
  static double N(int k, double x, int n, int degree = 2) {
    if (degree == 0) return x >= knot(k) && x < knot(k + 1) ? 1.0 : 0.0;
    return ((x - knot(k)) * N(k, x, n, degree - 1) +
            (knot(k + degree + 1) - x) * N(k + 1, x, n, degree - 1)) /
           degree;
  }
};

template <int Dim, class Functions_> struct Case {
  static constexpr int value = Dim;
  using Functions = Functions_;
};

/// A block of 5 cells along each axis in a grid of 7 x 5 x 6 (7 x 6 in plane strain), every point
/// then moved anywhere in the grid, with random velocity, stress and mass.
template <class Tested> class Transfer : public testing::Test {
 protected:
  static constexpr int dim = Tested::value;
  using Functions = typename Tested::Functions;
  using Shape = typename Functions::template Shape<dim>;
  static constexpr double h = 0.5;

  Transfer() : walls(scene(), state.grid), random(99) {
    auto& points = state.particles;
    for (const std::size_t p : rows_of(points)) {
      for (std::size_t i = 0; i < dim; ++i) {
        points.x[i][p] = state.grid.lower[i] + h * somewhere(state.grid.cells[i]);
        points.v[i][p] = random.between(-1.0, 1.0);
      }
      for (Column& component : points.tau) component[p] = random.between(-1.0, 1.0);
      points.m[p] = random.between(0.5, 1.5);
      points.V0[p] = random.between(0.5, 1.5);
    }
    state.order.update(points);
  }

  /// In cells; not within 0.001 of the cells' ends and of where GIMP points reach over them.
  double somewhere(int cells) {
    for (;;) {
      const double x = random.between(0.001, cells - 0.001);
      const double part = x - std::floor(x);
      const auto near = [part](double joint) { return std::abs(part - joint) < 1e-3; };
      if (!near(0.0) && !near(0.25) && !near(0.75) && !near(1.0)) return x;
    }
  }

  static Scene scene() {
    Scene scene;
    scene.grid = dim == 2 ? grid_2d(h, {-1.0, 2.0}, {2.5, 5.0})
                          : grid_3d(h, {-1.0, -3.0, 2.0}, {2.5, -0.5, 5.0});
    scene.materials = {elastic("m", 1.0, 1.0, 0.3)};
    scene.regions = {box("b", "m", {-1.0, 2.0}, {1.5, 4.5}, {}, {-3.0, -0.5})};
    return scene;
  }

  Vec<dim> place(int node) const {
    Vec<dim> x;
    for (std::size_t a = 0; a < dim; ++a) {
      const int n = state.grid.cells[a];
      x[a] = state.grid.lower[a] + h * Functions::place(node % Functions::nodes(n), n);
      node /= Functions::nodes(n);
    }
    return x;
  }

  /// N of a node at a point, and its gradient (1/m) by central differences, which are exact to
  /// rounding where the function is quadratic: points keep clear of the functions' joints.
  double hat(int node, std::size_t p, Vec<dim>* gradient = nullptr) const {
    constexpr double e = 1e-4;
    Vec<dim> along, slope;
    double N = 1.0;
    for (std::size_t a = 0; a < dim; ++a) {
      const int n = state.grid.cells[a];
      const int k = node % Functions::nodes(n);
      node /= Functions::nodes(n);
      const double x = (state.particles.x[a][p] - state.grid.lower[a]) / h;
      along[a] = Functions::N(k, x, n);
      slope[a] = (Functions::N(k, x + e, n) - Functions::N(k, x - e, n)) / (2.0 * e * h);
      N *= along[a];
    }
    if (gradient)
      for (std::size_t a = 0; a < dim; ++a) {
        (*gradient)[a] = slope[a];
        for (std::size_t b = 0; b < dim; ++b)
          if (b != a) (*gradient)[a] *= along[b];
      }
    return N;
  }

  struct Node {
    double m;
    Vec<dim> mv, f, v, dv; ///< mv: before the step
  };
  Node node(int index) const {
    const auto at = static_cast<std::size_t>(index);
    const auto& nodes = state.nodal.nodes;
    Node node = {nodes.m[at], {}, {}, {}, {}};
    for (std::size_t i = 0; i < dim; ++i) {
      node.f[i] = forces[i].at(at);
      node.v[i] = nodes.v[i][at];
      node.dv[i] = nodes.dv[i][at];
      node.mv[i] = node.m * (node.v[i] - node.dv[i]);
    }
    return node;
  }

  /// Every test's first step.
  void scatter_all() {
    scatter_pass<dim, Terms::all>(state);
    gather_momentum_pass(state, walls);
    advance_all();
  }
  void advance_all() {
    for (std::size_t i = 0; i < dim; ++i) forces[i] = by_node(state, state.nodal.sums.f[i]);
    advance_momentum_pass(state, walls, {}, 0.0, dt);
  }

  Vec<dim> momentum_of_points() const {
    Vec<dim> total = {};
    for (const std::size_t p : rows_of(state.particles))
      for (std::size_t i = 0; i < dim; ++i)
        total[i] += state.particles.m[p] * state.particles.v[i][p];
    return total;
  }

  static constexpr double dt = 0.01;
  State<dim, Shape> state{scene().grid, fill_regions<dim>(scene())};
  std::array<std::vector<double>, dim> forces; ///< N, by node
  Walls<dim> walls;                            // all sides free
  Random random;
};

using Cases = testing::Types<Case<2, Linear>, Case<3, Linear>, Case<2, Gimp>, Case<3, Gimp>,
                             Case<2, Spline>, Case<3, Spline>>;
struct CaseName {
  template <class Tested> static std::string GetName(int) {
    using Functions = typename Tested::Functions;
    const char* name = std::is_same_v<Functions, Linear> ? "linear"
                       : std::is_same_v<Functions, Gimp> ? "gimp"
                                                         : "spline";
    return name + std::to_string(Tested::value) + "d";
  }
};
TYPED_TEST_SUITE(Transfer, Cases, CaseName);

} // namespace

/// m_I = sum_p m_p N_I, (m v)_I = sum_p m_p v_p N_I, f_I = - sum_p V0 tau . grad N_I, node by node.
TYPED_TEST(Transfer, NodesHoldTheSumsOfTheTextbook) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  const auto& points = this->state.particles;
  std::size_t active = 0;
  for (int index = 0; index < this->state.grid.node_count; ++index) {
    double m = 0.0;
    Vec<Dim> mv = {}, f = {};
    for (const std::size_t p : rows_of(points)) {
      Vec<Dim> dN;
      const double N = this->hat(index, p, &dN);
      if (N == 0.0 && Vec<Dim>{} == dN) continue;
      m += points.m[p] * N;
      for (std::size_t i = 0; i < Dim; ++i) {
        mv[i] += points.m[p] * points.v[i][p] * N;
        for (std::size_t j = 0; j < Dim; ++j)
          f[i] -= points.V0[p] *
                  points.tau[component<Dim>(static_cast<int>(i), static_cast<int>(j))][p] * dN[j];
      }
    }
    if (m == 0.0) continue;
    ++active;
    EXPECT_NEAR(this->node(index).m, m, 1e-13);
    for (std::size_t i = 0; i < Dim; ++i) {
      EXPECT_NEAR(this->node(index).mv[i], mv[i], 1e-13);
      EXPECT_NEAR(this->node(index).f[i], f[i], 1e-9) << "gradients by differences";
    }
  }
  EXPECT_GT(active, Dim == 2 ? 40U : 200U);
  if constexpr (std::is_same_v<typename TypeParam::Functions, Gimp>)
    EXPECT_GE(active_nodes(this->state).size(), active) << "cells reach nodes that no point does";
  else
    EXPECT_EQ(active_nodes(this->state).size(), active);
}

TYPED_TEST(Transfer, ScatterConservesMassAndMomentum) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  double m = 0.0;
  Vec<Dim> mv = {};
  for (const int at : active_nodes(this->state)) {
    m += this->node(at).m;
    for (std::size_t i = 0; i < Dim; ++i) mv[i] += this->node(at).mv[i];
  }
  const double mass = sum(this->state.particles.m);
  EXPECT_NEAR(m, mass, 1e-14 * mass);
  for (std::size_t i = 0; i < Dim; ++i)
    EXPECT_NEAR(mv[i], this->momentum_of_points()[i], 1e-14 * mass);
}

/// Stress and momentum scattered apart (USF) are those scattered together (USL, MUSL), to rounding:
/// the compiler may contract the two instantiations' products and sums differently.
TYPED_TEST(Transfer, TermsApartAreTermsTogether) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  std::map<int, typename TestFixture::Node> together;
  for (const int at : active_nodes(this->state)) together[at] = this->node(at);
  scatter_pass<Dim, Terms::mass_momentum>(this->state);
  gather_momentum_pass(this->state, this->walls);
  scatter_pass<Dim, Terms::force>(this->state);
  this->advance_all();
  for (const int at : active_nodes(this->state)) {
    const auto& a = together.at(at);
    EXPECT_NEAR(this->node(at).m, a.m, 1e-14);
    for (std::size_t i = 0; i < Dim; ++i) {
      EXPECT_NEAR(this->node(at).mv[i], a.mv[i], 1e-14);
      EXPECT_NEAR(this->node(at).f[i], a.f[i], 1e-12);
    }
  }
}

/// The gradients of all shape functions add up to zero, so internal forces do.
TYPED_TEST(Transfer, InternalForcesCancel) {
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
TYPED_TEST(Transfer, ForceIsAdjointToTheGradient) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  double power = 0.0;
  for (const int at : active_nodes(this->state)) {
    auto& nodes = this->state.nodal.nodes;
    for (std::size_t i = 0; i < Dim; ++i) {
      nodes.v[i][at] = this->random.between(-1.0, 1.0);
      power += this->forces[i][static_cast<std::size_t>(at)] * nodes.v[i][at];
    }
  }
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
TYPED_TEST(Transfer, ForceIsMinusTheGradientOfTheEnergy) {
  constexpr int Dim = TypeParam::value;
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
    double power = 0.0;
    for (const int at : active_nodes(this->state)) {
      auto& nodes = this->state.nodal.nodes;
      for (std::size_t i = 0; i < Dim; ++i) {
        nodes.v[i][at] = this->random.between(-1.0, 1.0);
        power += this->forces[i][static_cast<std::size_t>(at)] * nodes.v[i][at];
      }
    }
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
TYPED_TEST(Transfer, CellAveragesOfTheVolumeRate) {
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

/// Affine transfers keep any linear velocity field, v = A x + b, to rounding.
TYPED_TEST(Transfer, AffineTransfersKeepALinearField) {
  constexpr int Dim = TypeParam::value;
  auto& points = this->state.particles;
  for (Column& column : points.tau) std::fill(column.begin(), column.end(), 0.0);
  Mat<Dim> A;
  for (auto& row : A)
    for (Real& entry : row) entry = this->random.between(-1.0, 1.0);
  for (std::size_t i = 0; i < Dim; ++i)
    for (std::size_t j = 0; j < Dim; ++j) points.C[Dim * i + j].assign(points.rows(), A[i][j]);
  for (const std::size_t p : rows_of(points))
    for (std::size_t i = 0; i < Dim; ++i) {
      points.v[i][p] = 0.7;
      for (std::size_t j = 0; j < Dim; ++j) points.v[i][p] += A[i][j] * points.x[j][p];
    }
  const auto v = points.v;
  this->scatter_all();
  gather_pass<Dim, true>(this->state, 0.0);
  remap_velocity_pass(this->state, this->walls, this->dt);
  for (const int at : active_nodes(this->state)) {
    if (this->node(at).m < 1e-6) continue; // of rounding's size
    for (std::size_t i = 0; i < Dim; ++i) {
      double expected = 0.7;
      for (std::size_t j = 0; j < Dim; ++j) expected += A[i][j] * this->place(at)[j];
      EXPECT_NEAR(this->node(at).v[i], expected, 1e-8);
    }
  }
  for (const std::size_t p : rows_of(points))
    for (std::size_t i = 0; i < Dim; ++i) {
      EXPECT_NEAR(points.v[i][p], v[i][p], 1e-9);
      for (std::size_t j = 0; j < Dim; ++j) EXPECT_NEAR(points.C[Dim * i + j][p], A[i][j], 1e-6);
    }
}

/// To the points and back, affine transfers keep the nodes' momentum and angular momentum; plain
/// PIC loses angular momentum.
TYPED_TEST(Transfer, AffineTransfersKeepAngularMomentum) {
  constexpr int Dim = TypeParam::value;
  constexpr std::size_t z = Dim - 1;
  auto& points = this->state.particles;
  for (Column& column : points.tau) std::fill(column.begin(), column.end(), 0.0);
  const auto angular = [&] {
    double L = 0.0;
    for (const int at : active_nodes(this->state)) {
      const Vec<Dim> x = this->place(at);
      L += x[z] * this->node(at).mv[0] - x[0] * this->node(at).mv[z];
    }
    return L;
  };
  const auto change = [&] {
    this->scatter_all();
    const double before = angular();
    gather_pass<Dim, false>(this->state, 0.0);
    scatter_pass<Dim, Terms::mass_momentum>(this->state);
    gather_momentum_pass(this->state, this->walls);
    return std::abs(angular() - before);
  };
  const double scale = sum(points.m);
  EXPECT_GT(change(), 1e-6 * scale) << "PIC";
  for (Column& column : points.C) column.assign(points.rows(), 0.0);
  EXPECT_LT(change(), 1e-12 * scale) << "APIC";
}

/// J' = J (2 + x)/(2 - x), exp(x) to second order, with x = dt div v, and nothing else touches J; a
/// uniform velocity strains nothing.
TYPED_TEST(Transfer, VolumeFollowsTheDivergence) {
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

TYPED_TEST(Transfer, UniformVelocityStays) {
  constexpr int Dim = TypeParam::value;
  for (const Real flip : {1.0, 0.0, 0.7}) {
    auto& points = this->state.particles;
    for (Column& column : points.tau) std::fill(column.begin(), column.end(), 0.0);
    for (std::size_t i = 0; i < Dim; ++i)
      std::fill(points.v[i].begin(), points.v[i].end(), 1.0 + static_cast<double>(i));
    this->scatter_all();
    const Real fastest = gather_pass<Dim, false>(this->state, flip);
    const auto start = points.x;
    move_pass(this->state, this->dt, [](std::size_t) {});
    for (const std::size_t p : rows_of(points)) {
      Vec<Dim> there;
      for (std::size_t i = 0; i < Dim; ++i)
        there[i] = start[i][p] + this->dt * (1.0 + static_cast<double>(i));
      const bool stays = !this->state.grid.contains(there);
      for (std::size_t i = 0; i < Dim; ++i) {
        EXPECT_NEAR(points.v[i][p], 1.0 + static_cast<double>(i), 1e-14);
        EXPECT_NEAR(points.x[i][p], stays ? start[i][p] : there[i], 2e-15);
      }
    }
    EXPECT_NEAR(fastest, std::sqrt(Dim == 2 ? 5.0 : 14.0), 1e-14);
  }
}

/// Neither FLIP nor PIC makes momentum: internal forces cancel, gravity adds dt m g.
TYPED_TEST(Transfer, MomentumIsConserved) {
  constexpr int Dim = TypeParam::value;
  for (const Real flip : {1.0, 0.0, 0.7}) {
    const Vec<Dim> before = this->momentum_of_points();
    Vec<Dim> g = {};
    g[0] = 2.0;
    g[Dim - 1] = -9.81;
    scatter_pass<Dim, Terms::all>(this->state);
    gather_momentum_pass(this->state, this->walls);
    advance_momentum_pass(this->state, this->walls, g, 0.0, this->dt);
    gather_pass<Dim, false>(this->state, flip);
    const double mass = sum(this->state.particles.m);
    for (std::size_t i = 0; i < Dim; ++i)
      EXPECT_NEAR(this->momentum_of_points()[i], before[i] + this->dt * mass * g[i], 1e-13 * mass);
  }
}

/// v_p = flip (v_p + sum N dv) + (1 - flip) sum N v, x_p += dt sum N v, for random nodal values.
TYPED_TEST(Transfer, BlendOfFlipAndPic) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  for (const int at : active_nodes(this->state)) {
    auto& nodes = this->state.nodal.nodes;
    for (std::size_t i = 0; i < Dim; ++i) {
      nodes.v[i][at] = this->random.between(-1.0, 1.0);
      nodes.dv[i][at] = this->random.between(-1.0, 1.0);
    }
  }
  const auto start = this->state.particles.v;
  const auto x_start = this->state.particles.x;
  const Real flip = 0.7;
  gather_pass<Dim, false>(this->state, flip);
  move_pass(this->state, this->dt, [](std::size_t) {});
  const auto& points = this->state.particles;
  const auto moved = points.x;
  this->state.particles.x = x_start; // the weights are those of the start
  for (const std::size_t p : rows_of(points)) {
    Vec<Dim> v = {}, dv = {}, there;
    for (int index = 0; index < this->state.grid.node_count; ++index) {
      const double N = this->hat(index, p);
      if (N == 0.0) continue;
      for (std::size_t i = 0; i < Dim; ++i) {
        v[i] += N * this->node(index).v[i];
        dv[i] += N * this->node(index).dv[i];
      }
    }
    for (std::size_t i = 0; i < Dim; ++i) {
      EXPECT_NEAR(points.v[i][p], flip * (start[i][p] + dv[i]) + (1.0 - flip) * v[i], 1e-13);
      there[i] = x_start[i][p] + this->dt * v[i];
    }
    const bool stays = !this->state.grid.contains(there);
    for (std::size_t i = 0; i < Dim; ++i)
      EXPECT_NEAR(moved[i][p], stays ? x_start[i][p] : there[i], 2e-15);
  }
}

/// MUSL's second mapping: v_I from the points' new momenta with the weights of the first.
TYPED_TEST(Transfer, RemapGivesTheNewMomenta) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  gather_pass<Dim, true>(this->state, 1.0);
  remap_velocity_pass(this->state, this->walls, this->dt);
  const auto& points = this->state.particles;
  for (const int at : active_nodes(this->state)) {
    double m = 0.0;
    Vec<Dim> mv = {};
    for (const std::size_t p : rows_of(points)) {
      const double N = this->hat(at, p);
      m += points.m[p] * N;
      for (std::size_t i = 0; i < Dim; ++i) mv[i] += points.m[p] * points.v[i][p] * N;
    }
    if (m == 0.0) continue; // GIMP: a cell reaches nodes that none of its points does
    for (std::size_t i = 0; i < Dim; ++i)
      EXPECT_NEAR(this->node(at).v[i], mv[i] / m, 1e-13 / std::min(m, 1.0));
  }
}

/// Points that wander stay in their cells' rows, with all their state,
/// whether tiles grow one by one or all rows are put in order.
TYPED_TEST(Transfer, OrderFollowsWanderingPoints) {
  constexpr int Dim = TypeParam::value;
  auto& points = this->state.particles;
  std::vector<double> first_mass;
  for (const std::size_t p : rows_of(points)) {
    if (first_mass.size() <= points.id[p]) first_mass.resize(points.id[p] + 1);
    first_mass[points.id[p]] = points.m[p];
  }
  std::size_t put_in_order = 0;
  for (int round = 0; round < 60; ++round) {
    const double part = round % 3 == 0 ? 0.01 : round % 20 == 1 ? 0.5 : 0.05; // to move
    for (const std::size_t p : rows_of(points))
      if (this->random.between(0.0, 1.0) < part)
        for (std::size_t i = 0; i < Dim; ++i)
          points.x[i][p] = this->state.grid.lower[i] +
                           this->h * this->state.grid.cells[i] * this->random.between(0.0, 0.999);
    const std::size_t rows = points.rows();
    this->state.order.update(points);
    put_in_order += points.rows() < rows;

    std::vector<int> seen(first_mass.size(), 0);
    for (const auto& cell : this->state.order.cells()) {
      EXPECT_GT(cell.count, 0U);
      EXPECT_EQ(cell.first_node, this->state.grid.first_node(cell.along));
      for (std::size_t k = 0; k < cell.count; ++k) {
        const std::size_t p = cell.row(k);
        EXPECT_EQ(this->state.grid.along(this->state.grid.cell_of(points.position(p))), cell.along);
        ASSERT_LT(points.id[p], seen.size());
        EXPECT_EQ(points.m[p], first_mass[points.id[p]]) << "all columns move together";
        ++seen[points.id[p]];
      }
    }
    for (const int times : seen) EXPECT_EQ(times, 1);
    EXPECT_EQ(rows_of(points).size(), seen.size());
    for (std::size_t p = 0; p < points.rows(); ++p)
      if (points.id[p] == no_point) {
        EXPECT_EQ(points.m[p], 0.0);
        EXPECT_EQ(points.V0[p], 0.0);
        EXPECT_EQ(points.J[p], 1.0);
      }
    this->scatter_all();
    double m = 0.0;
    for (const int at : active_nodes(this->state)) m += this->node(at).m;
    EXPECT_NEAR(m, sum(points.m), 1e-13 * m) << "every node of an occupied cell is active";
  }
  EXPECT_GT(put_in_order, 0U);
}

/// The mapping to the nodes keeps angular momentum, since sum_I N_I x_I = x; and since tau is
/// symmetric, internal forces turn nothing: sum_I x_I x f_I = 0.  About the axis normal to the
/// first and the last axis.
TYPED_TEST(Transfer, AngularMomentumAndTorque) {
  constexpr int Dim = TypeParam::value;
  this->scatter_all();
  const auto& points = this->state.particles;
  constexpr std::size_t z = Dim - 1;
  double L = 0.0, L_p = 0.0, torque = 0.0, size = 0.0;
  for (const int at : active_nodes(this->state)) {
    const Vec<Dim> x = this->place(at);
    const auto& node = this->node(at);
    L += x[z] * node.mv[0] - x[0] * node.mv[z];
    torque += x[z] * node.f[0] - x[0] * node.f[z];
    size += std::abs(x[z] * node.f[0]) + std::abs(x[0] * node.f[z]);
  }
  for (const std::size_t p : rows_of(points))
    L_p += points.m[p] * (points.x[z][p] * points.v[0][p] - points.x[0][p] * points.v[z][p]);
  EXPECT_NEAR(L, L_p, 1e-13 * sum(points.m));
  EXPECT_NEAR(torque, 0.0, 1e-14 * size);
}
