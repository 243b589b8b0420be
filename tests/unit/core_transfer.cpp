// Points to nodes and back, at random points with random state, for all shape functions.  Nodes are
// found and weighted here by the textbook's functions, not by the code's own.
#include "core/affine.hpp"
#include "tests/support/random_points.hpp"

#include <cmath>
#include <map>
#include <type_traits>

using namespace scarp;
using namespace scarp::test;

namespace {

template <class Tested> class Transfer : public RandomPoints<Tested> {};
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
      m += points.mass(p) * N;
      for (std::size_t i = 0; i < Dim; ++i) {
        mv[i] += points.mass(p) * points.v[i][p] * N;
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
  const double mass = sum(masses_of(this->state.particles));
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
  const double scale = sum(masses_of(points));
  EXPECT_GT(change(), 1e-6 * scale) << "PIC";
  for (Column& column : points.C) column.assign(points.rows(), 0.0);
  EXPECT_LT(change(), 1e-12 * scale) << "APIC";
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
    const double mass = sum(masses_of(this->state.particles));
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
      m += points.mass(p) * N;
      for (std::size_t i = 0; i < Dim; ++i) mv[i] += points.mass(p) * points.v[i][p] * N;
    }
    if (m == 0.0) continue; // GIMP: a cell reaches nodes that none of its points does
    for (std::size_t i = 0; i < Dim; ++i)
      EXPECT_NEAR(this->node(at).v[i], mv[i] / m, 1e-13 / std::min(m, 1.0));
  }
}

/// The motion tells the order which tiles' points have left their cells, so that it need not look
/// at the others.
TYPED_TEST(Transfer, OrderLooksWherePointsHaveLeft) {
  const auto in_own_cell = [&](const auto& cell, std::size_t p) {
    return this->state.grid.along(this->state.grid.cell_of(this->state.particles.position(p))) ==
           cell.along;
  };
  int tiles_to_look_at = 0, others = 0;
  for (int round = 0; round < 20; ++round) {
    for (auto& component : this->state.nodal.nodes.v)
      for (auto& v : component)
        v = static_cast<std::remove_reference_t<decltype(v)>>(this->random.between(-1.0, 1.0));
    move_pass(this->state, 0.02 * this->h, [](std::size_t) {});
    for (std::size_t tile = 0; tile < this->state.order.tiles().size(); ++tile) {
      ++(this->state.left[tile] != 0 ? tiles_to_look_at : others);
      if (this->state.left[tile] != 0) continue;
      for_each_cell_of(this->state, tile, [&](const auto& cell) {
        for (std::size_t k = 0; k < cell.count; ++k) EXPECT_TRUE(in_own_cell(cell, cell.row(k)));
      });
    }
    this->state.order.update(this->state.particles, this->state.left);
    std::size_t points = 0;
    for (const auto& cell : this->state.order.cells())
      for (std::size_t k = 0; k < cell.count; ++k, ++points)
        EXPECT_TRUE(in_own_cell(cell, cell.row(k)));
    EXPECT_EQ(points, rows_of(this->state.particles).size());
  }
  EXPECT_GT(tiles_to_look_at, 10);
  EXPECT_GT(others, 10);
}

/// Points that wander stay in their cells' rows, with all their state,
/// whether tiles grow one by one or all rows are put in order.
TYPED_TEST(Transfer, OrderFollowsWanderingPoints) {
  constexpr int Dim = TypeParam::value;
  auto& points = this->state.particles;
  std::vector<double> first_mass;
  for (const std::size_t p : rows_of(points)) {
    if (first_mass.size() <= points.id[p]) first_mass.resize(points.id[p] + 1);
    first_mass[points.id[p]] = points.mass(p);
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
        EXPECT_EQ(points.mass(p), first_mass[points.id[p]]) << "all columns move together";
        ++seen[points.id[p]];
      }
    }
    for (const int times : seen) EXPECT_EQ(times, 1);
    EXPECT_EQ(rows_of(points).size(), seen.size());
    for (std::size_t p = 0; p < points.rows(); ++p)
      if (points.id[p] == no_point) {
        EXPECT_EQ(points.mass(p), 0.0);
        EXPECT_EQ(points.V0[p], 0.0);
        EXPECT_EQ(points.J[p], 1.0);
      }
    this->scatter_all();
    double m = 0.0;
    for (const int at : active_nodes(this->state)) m += this->node(at).m;
    EXPECT_NEAR(m, sum(masses_of(points)), 1e-13 * m) << "every node of an occupied cell is active";
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
    L_p += points.mass(p) * (points.x[z][p] * points.v[0][p] - points.x[0][p] * points.v[z][p]);
  EXPECT_NEAR(L, L_p, 1e-13 * sum(masses_of(points)));
  EXPECT_NEAR(torque, 0.0, 1e-14 * size);
}

/// Points of one density keep no masses; with masses of their own all goes the same way.
TYPED_TEST(Transfer, OneDensityNeedsNoMasses) {
  constexpr int Dim = TypeParam::value;
  auto& points = this->state.particles;
  const auto step = [&] {
    this->scatter_all();
    const auto m = this->state.nodal.nodes.m;
    gather_pass<Dim, true>(this->state, 0.5);
    return std::pair(m, by_node(this->state, this->state.nodal.sums.mv[0]));
  };
  points.density = 3.0;
  points.m.resize(points.rows());
  for (std::size_t p = 0; p < points.rows(); ++p) points.m[p] = points.density * points.V0[p];
  const auto v = points.v;
  const auto with_masses = step();
  points.m = {};
  points.v = v;
  EXPECT_EQ(step(), with_masses);
}

/// FLIP of velocities and their gradients, core/affine.hpp: what the step adds on the nodes, dv,
/// gives the points sum_I m_I v_I . dv_I and something that is not more than the nodes' own second
/// order; without it the points' |s| does not grow, and with all of FLIP stays.
TYPED_TEST(Transfer, AffineFlipMakesNoEnergy) {
  constexpr int Dim = TypeParam::value;
  auto& points = this->state.particles;
  for (Column& column : points.C) {
    column.assign(points.rows(), 0.0);
    for (const std::size_t p : rows_of(points)) column[p] = this->random.between(-2.0, 2.0);
  }
  const auto v = points.v;
  const auto C = points.C;
  const auto energy = [&] {
    double twice = 0.0;
    for (const std::size_t p : rows_of(points)) {
      double v2 = affine_square(this->state, p);
      for (std::size_t i = 0; i < Dim; ++i) v2 += points.v[i][p] * points.v[i][p];
      twice += points.mass(p) * v2;
    }
    return 0.5 * twice;
  };
  const double before = energy();
  for (const double flip : {0.0, 0.3, 1.0})
    for (const bool pushed : {false, true}) {
      points.v = v;
      points.C = C;
      scatter_pass<Dim, Terms::mass_momentum>(this->state);
      gather_momentum_pass(this->state, this->walls);
      auto& nodes = this->state.nodal.nodes;
      double first = 0.0, second = 0.0, seen = 0.0;
      for (const int index : active_nodes(this->state)) {
        const auto at = static_cast<std::size_t>(index);
        for (std::size_t i = 0; i < Dim; ++i) {
          const double dv = pushed ? this->random.between(-1.0, 1.0) : 0.0;
          first += nodes.m[at] * nodes.v[i][at] * dv;
          second += 0.5 * nodes.m[at] * dv * dv;
          seen += 0.5 * nodes.m[at] * nodes.v[i][at] * nodes.v[i][at];
          nodes.dv[i][at] = dv;
          nodes.v[i][at] += dv;
        }
      }
      ASSERT_LT(seen, 0.9 * before) << "of random points the nodes see a part only";
      gather_pass<Dim, false>(this->state, flip);
      const double made = energy() - before - first;
      EXPECT_LT(made, second + 1e-12 * before) << flip;
      if (flip == 1.0) {
        EXPECT_GT(made, -1e-12 * before) << "nothing is lost";
      }
      if (pushed) continue;
      if (flip == 1.0) {
        EXPECT_NEAR(made, 0.0, 1e-12 * before);
      } else {
        EXPECT_LT(made, (1.0 - flip) * (seen - before) + 1e-12 * before) << flip;
      }
    }
}
