// Points anywhere with random state, and the textbook's shape functions to check the code's own.
#pragma once

#include "core/compiled_passes.hpp"
#include "core/lattice.hpp"
#include "tests/support/nodes.hpp"
#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace scarp::test {

/// max(0, 1 - |x|), and its integral from minus infinity.
inline double hat_function(double x) { return std::max(0.0, 1.0 - std::abs(x)); }
inline double hat_integral(double x) {
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
template <class Tested> class RandomPoints : public testing::Test {
 protected:
  static constexpr int dim = Tested::value;
  using Functions = typename Tested::Functions;
  using Shape = typename Functions::template Shape<dim>;
  static constexpr double h = 0.5;

  RandomPoints() : walls(scene(), state.grid), random(99) {
    auto& points = state.particles;
    points.m.resize(points.rows());
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
        total[i] += state.particles.mass(p) * state.particles.v[i][p];
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

} // namespace scarp::test
