// The passes against those of core/reference, which take a point and a node at a time: the same to
// rounding, for any number of points in a cell, rows out of order, several materials, and options.
#include "core/compiled_passes.hpp"
#include "core/lattice.hpp"
#include "core/reference/gather_pass.hpp"
#include "core/reference/move_pass.hpp"
#include "core/reference/scatter_pass.hpp"
#include "core/reference/stress_pass.hpp"
#include "tests/support/nodes.hpp"
#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace scarp;
using namespace scarp::test;

namespace {

template <int Dim> Scene block() {
  Scene scene;
  scene.grid = Dim == 2 ? grid_2d(0.5, {-1.0, 2.0}, {4.0, 6.0})
                        : grid_3d(0.5, {-1.0, -3.0, 2.0}, {2.5, -0.5, 5.0});
  scene.materials = {elastic("m", 1.0, 1.0, 0.3)};
  scene.regions = {box("b", "m", {-1.0, 2.0}, {Dim == 2 ? 3.0 : 1.0, 4.5}, {}, {-3.0, -0.5})};
  return scene;
}

/// Random points, most of them crowded into a few cells, some moved after the columns were sorted.
template <int Dim, class Shape>
std::unique_ptr<State<Dim, Shape>> random_state(const Scene& scene, bool affine) {
  using Number = typename Shape::Number;
  auto state = std::make_unique<State<Dim, Shape>>(
      scene.grid, Particles<Dim, Number>(fill_regions<Dim>(scene)), true);
  auto& points = state->particles;
  Random random(7);
  const auto between = [&](double lower, double upper) {
    return static_cast<Number>(random.between(lower, upper));
  };
  const auto anywhere = [&](std::size_t p) {
    for (std::size_t i = 0; i < Dim; ++i) {
      const double part = random.between(0.0, 0.999);
      points.x[i][p] =
          state->grid.lower[i] +
          0.5 * state->grid.cells[i] * (points.id[p] % 4 == 0 ? part : part * part * part);
    }
  };
  points.m.resize(points.rows());
  for (const std::size_t p : rows_of(points)) {
    anywhere(p);
    for (auto& component : points.v) component[p] = between(-1.0, 1.0);
    for (auto& component : points.tau) component[p] = between(-1.0, 1.0);
    if (affine)
      for (auto& component : points.C) component.push_back(between(-1.0, 1.0));
    points.m[p] = between(0.5, 1.5);
    points.V0[p] = between(0.5, 1.5);
    points.gap[p] = between(0.0, 0.1);
    points.material[p] = p % 3 == 0;
    points.region[p] = p % 2;
  }
  state->order.update(points);
  std::vector<std::size_t> row_of(rows_of(points).size());
  for (const std::size_t p : rows_of(points)) row_of[points.id[p]] = p;
  for (std::size_t id = 0; id < row_of.size(); id += 41) anywhere(row_of[id]);
  state->order.update(points);
  auto& nodes = state->nodal.nodes;
  for (std::size_t n = 0; n < nodes.m.size(); ++n) {
    for (auto& v : nodes.v) v[n] = between(-1.0, 1.0);
    for (auto& dv : nodes.dv) dv[n] = between(-1.0, 1.0);
    nodes.fraction[n] = between(0.2, 1.2);
  }
  return state;
}

/// Of numbers in the precision of T: one part in 10^13, or in 10^5 (sums cancel).
template <class T>
void expect_same(const std::vector<double>& a, const std::vector<double>& b, const char* what,
                 double tolerance = 1e-13) {
  if (std::is_same_v<T, float>) tolerance = 2e-5;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    ASSERT_NEAR(a[k], b[k], tolerance * (1.0 + std::abs(b[k]))) << what << ' ' << k;
}

/// By id: rows differ where tiles have another number of cells.
template <int Dim, class T, class Number>
std::vector<double> by_id(const Particles<Dim, T>& points, const ColumnOf<Number>& column) {
  const std::vector<std::size_t> rows = rows_of(points);
  std::vector<double> values(rows.size());
  for (const std::size_t p : rows) values.at(points.id[p]) = column[p];
  return values;
}

template <int Dim, class Shape, class Plain>
void expect_same(const State<Dim, Shape>& a, const State<Dim, Plain>& b, bool with_sums) {
  using T = typename Shape::Number;
  const auto same = [&](const ColumnOf<T>& column, const Column& other, const char* what,
                        double tolerance = 1e-13) {
    expect_same<T>(by_id(a.particles, column), by_id(b.particles, other), what, tolerance);
  };
  for (std::size_t i = 0; i < Dim; ++i) {
    same(a.particles.v[i], b.particles.v[i], "v");
    expect_same<T>(by_id(a.particles, a.particles.x[i]), by_id(b.particles, b.particles.x[i]), "x",
                   1e-14);
  }
  for (std::size_t i = 0; a.particles.affine() && i < a.particles.C.size(); ++i)
    same(a.particles.C[i], b.particles.C[i], "C", 1e-12);
  for (std::size_t i = 0; i < a.particles.tau.size(); ++i)
    same(a.particles.tau[i], b.particles.tau[i], "tau");
  same(a.particles.J, b.particles.J, "J");
  same(a.particles.gap, b.particles.gap, "gap");
  same(a.particles.plastic_strain, b.particles.plastic_strain, "plastic strain");
  same(a.particles.dissipation, b.particles.dissipation, "dissipation");
  if (!with_sums) return;
  const auto same_sums = [&](const auto& lines, const auto& others, const char* what) {
    expect_same<T>(by_node(a, lines), by_node(b, others), what, 1e-11);
  };
  same_sums(a.nodal.sums.m, b.nodal.sums.m, "m");
  same_sums(a.nodal.sums.V0, b.nodal.sums.V0, "V0");
  for (std::size_t i = 0; i < Dim; ++i) {
    same_sums(a.nodal.sums.mv[i], b.nodal.sums.mv[i], "m v");
    same_sums(a.nodal.sums.f[i], b.nodal.sums.f[i], "f");
  }
}

template <int Dim, class Shape, class Plain = Shape> void check_all_passes(bool affine = false) {
  const Scene scene = block<Dim>();
  const auto fast = random_state<Dim, Shape>(scene, affine);
  const auto plain = random_state<Dim, Plain>(scene, affine);
  Vec<Dim> b = {};
  b[0] = 3.0;
  for (const bool averages : {false, true}) {
    fast->averages_volume = plain->averages_volume = averages;
    fast->moves_with_strain = plain->moves_with_strain = averages && affine;
    for (const auto& own_force : {std::vector<Vec<Dim>>(), std::vector<Vec<Dim>>{b, {}}}) {
      scatter_pass<Dim, Terms::all>(*fast, own_force);
      reference::scatter_pass<Dim, Terms::all>(*plain, own_force);
      expect_same(*fast, *plain, true);
    }
    const Real a = gather_pass<Dim, true>(*fast, 0.9);
    const Real c = reference::gather_pass<Dim, true>(*plain, 0.9);
    EXPECT_NEAR(a, c, (std::is_same_v<Shape, Plain> ? 1e-13 : 1e-6));
    expect_same(*fast, *plain, true);

    DruckerPrager law;
    law.friction_angle = 30.0;
    const ElasticModuli moduli = {2.0, 1.0};
    const auto update = DruckerPragerUpdate::from(law, moduli);
    law.residual = {.friction_angle = 20.0, .residual_strain = 0.5};
    law.rate_strengthening = 1.0;
    law.grain_diameter = 0.1;
    const auto evolving = EvolvingStrengthUpdate::from(law, moduli, 1.0);
    const auto stress = [&](std::uint8_t material, const auto& of_material) {
      stress_pass<Dim>(*fast, material, moduli, of_material, material == 1, 0.01);
      reference::stress_pass<Dim>(*plain, material, moduli, of_material, material == 1, 0.01);
    };
    stress(0, update);
    stress(1, update);
    stress(1, evolving);
    expect_same(*fast, *plain, false);

    fast->nodal.remapped = plain->nodal.remapped = true;
    const LostPoints lost = move_pass(*fast, 0.01, [](std::size_t) {});
    const LostPoints of_plain = reference::move_pass(*plain, 0.01);
    EXPECT_EQ(lost.outside, of_plain.outside);
    EXPECT_EQ(lost.turned_over, of_plain.turned_over);
    expect_same(*fast, *plain, false);
  }
}

} // namespace

TEST(AgainstReference, LinearPlaneStrain) { check_all_passes<2, LinearShape<2>>(); }
TEST(AgainstReference, Linear3d) { check_all_passes<3, LinearShape<3>>(); }
TEST(AgainstReference, SplinePlaneStrain) { check_all_passes<2, SplineShape<2>>(); }
TEST(AgainstReference, Spline3d) { check_all_passes<3, SplineShape<3>>(); }
TEST(AgainstReference, SingleLinearPlaneStrain) {
  check_all_passes<2, LinearShape<2, float>, LinearShape<2>>();
}
TEST(AgainstReference, SingleLinear3d) {
  check_all_passes<3, LinearShape<3, float>, LinearShape<3>>();
}
TEST(AgainstReference, SingleSplinePlaneStrain) {
  check_all_passes<2, SplineShape<2, float>, SplineShape<2>>();
}
TEST(AgainstReference, SingleSpline3d) {
  check_all_passes<3, SplineShape<3, float>, SplineShape<3>>();
}
TEST(AgainstReference, AffineSplinePlaneStrain) { check_all_passes<2, SplineShape<2>>(true); }
TEST(AgainstReference, AffineSpline3d) { check_all_passes<3, SplineShape<3>>(true); }
TEST(AgainstReference, SingleAffineSplinePlaneStrain) {
  check_all_passes<2, SplineShape<2, float>, SplineShape<2>>(true);
}
TEST(AgainstReference, AffineLinear3d) { check_all_passes<3, LinearShape<3>>(true); }
TEST(AgainstReference, GimpPlaneStrain) { check_all_passes<2, GimpShape<2>>(); }
TEST(AgainstReference, Gimp3d) { check_all_passes<3, GimpShape<3>>(); }
