// The stress of a body at rest under its loads, in the geometry in which it is given.
//
// Sought are stresses that the law admits and whose forces balance the loads at every node that can
// move,
//   sum_p V0_p tau_p . grad N_I = sum_p m_p b_p N_I,
// the forces being those of the step (core/stress_pass.hpp, with its cell averages), so that it
// finds nothing to move.  They follow from displacements u by the method of initial stress
// (Zienkiewicz, Valliappan & King 1969, doi 10.1002/nme.1620010107; Griffiths & Lane 1999):
//   du = K^-1 (f_ext - f_int(tau)),   tau <- the law's return of tau + D B du,
// with the elastic K throughout.  First without the return, as if all were elastic: K is linear, so
// few iterations show whether walls and gates hold the body at all.
//
// u serves to find tau alone.  The points stay where they are and their J is 1, so tau is sigma;
// plastic strain, dissipation and gaps count from this state on, and are 0 in it.  Where material
// yields, the state is one of those that the loads allow, as one put on at once gives it.
#pragma once

#include "core/error.hpp"
#include "core/material_model.hpp"
#include "core/sparse_system.hpp"
#include "core/state.hpp"
#include "core/stress_pass.hpp"
#include "core/walls.hpp"

#include <cmath>
#include <span>
#include <sstream>
#include <vector>

namespace scarp {

struct Equilibrium {
  int unknowns = 0;
  int iterations = 0;  ///< 0: there is no load
  Real residual = 0.0; ///< -, nodal forces out of balance over loads on nodes that can move
};

template <int Dim, class Shape> class StaticEquilibrium {
 public:
  StaticEquilibrium(State<Dim, Shape>& state, const Walls<Dim>& walls,
                    const std::vector<MaterialModel>& materials)
      : state_(state), materials_(materials) {
    std::size_t points = 0;
    for (const Cell& cell : state.order.cells()) {
      cells_.push_back({cell, points});
      points += cell.count;
    }
    tau_.resize(points);
    number_unknowns(walls);
  }

  /// Gives the points their stress under the loads b(p), m/s2, of rows p.  Throws SetupError if
  /// walls and gates do not hold the body, or if it yields without an end or nearly so.
  template <class BodyForce> Equilibrium find(BodyForce&& b) {
    add_up_loads(b);
    load_ = norm(loads_);
    if (load_ == 0.0) return {unknowns_, 0, 0.0};
    using Solver = SparseSystem::Solver;
    SparseSystem stiffness(unknowns_, Dim == 2 ? Solver::factors : Solver::gradients);
    assemble(stiffness);

    unbalanced_ = loads_;
    Real left = balance(stiffness, elastic);
    if (!(left <= elastic.tolerance)) refuse(left, elastic);
    follow(Unknowns(loads_.size(), 0.0), plastic.yields);
    left = balance(stiffness, plastic);
    if (!(left <= plastic.tolerance)) refuse(left, plastic);

    for (const OccupiedCell& cell : cells_)
      for (std::size_t k = 0; k < cell.count; ++k)
        for (std::size_t i = 0; i < tensor_size<Dim>; ++i)
          state_.particles.tau[i][cell.row(k)] =
              static_cast<typename Shape::Number>(tau_[cell.first_point + k][i]);
    return {unknowns_, iterations_, left};
  }

 private:
  using AtNodes = std::array<Vec<Dim>, Shape::nodes>; ///< of a cell
  using Unknowns = std::vector<Real>;
  using Cell = typename CellOrder<Dim, Shape::width, tile_cells<typename Shape::Number>>::Cell;
  struct OccupiedCell : Cell {
    std::size_t first_point; ///< in tau_
  };

  struct Rule {
    bool yields;
    Real tolerance; ///< of what is left of the loads
    int most;       ///< iterations
    int window;     ///< iterations that show their pace
    const char* what;
    const char* reason;
  };
  static constexpr Rule elastic = {false,
                                   1e-10,
                                   30,
                                   1,
                                   "as if it were elastic",
                                   "walls and gates do not hold the body; hold it"};
  /// With as many iterations as Griffiths & Lane 1999: their slope of F = 1.4 is balanced up to F
  /// = 1.2.
  static constexpr Rule plastic = {
      true, 1e-6, 1000, 50, "at its strength", "the body fails or is close to it; support it"};

  /// Of a nodal component: `sign` times an unknown; sign 0: it does not move.
  struct Unknown {
    int index = 0;
    Real sign = 0.0;
  };

  const Unknown& unknown(const Cell& cell, std::size_t corner, std::size_t component) const {
    const int node = cell.first_node + state_.grid.corner_offset[corner];
    return of_node_[static_cast<std::size_t>(node)][component];
  }

  void number_unknowns(const Walls<Dim>& walls) {
    const auto nodes = static_cast<std::size_t>(state_.grid.node_count);
    std::vector<std::array<int, Dim>> number(nodes);
    for (auto& of_node : number) of_node.fill(-1);
    of_node_.resize(nodes);
    for (const OccupiedCell& cell : cells_)
      for (std::size_t c = 0; c < Shape::nodes; ++c)
        for (std::size_t i = 0; i < Dim; ++i) {
          const int node = cell.first_node + state_.grid.corner_offset[c];
          const auto [moves_with, sign] = walls.degree_of_freedom(node, i);
          if (sign == 0.0) continue;
          int& index = number[static_cast<std::size_t>(moves_with)][i];
          if (index < 0) index = unknowns_++;
          of_node_[static_cast<std::size_t>(node)][i] = {index, sign};
        }
  }

  AtNodes displacements(const Cell& cell, const Unknowns& q) const {
    AtNodes u;
    for (std::size_t c = 0; c < Shape::nodes; ++c)
      for (std::size_t i = 0; i < Dim; ++i) {
        const auto [index, sign] = unknown(cell, c, i);
        u[c][i] = sign == 0.0 ? 0.0 : sign * q[static_cast<std::size_t>(index)];
      }
    return u;
  }

  void add_to_unknowns(const Cell& cell, const AtNodes& f, Unknowns& sums) const {
    for (std::size_t c = 0; c < Shape::nodes; ++c)
      for (std::size_t i = 0; i < Dim; ++i)
        if (const auto [index, sign] = unknown(cell, c, i); sign != 0.0)
          sums[static_cast<std::size_t>(index)] += sign * f[c][i];
  }

  /// At the points of a cell.
  std::vector<Shape> shapes_in(const Cell& cell) const {
    const StencilCell<Dim> stencil = stencil_cell(state_, cell);
    std::vector<Shape> shapes;
    shapes.reserve(cell.count);
    for (std::size_t k = 0; k < cell.count; ++k)
      shapes.push_back(shape_at(state_, stencil, cell.row(k)));
    return shapes;
  }

  template <class BodyForce> void add_up_loads(BodyForce&& b) {
    loads_.assign(static_cast<std::size_t>(unknowns_), 0.0);
    for (const OccupiedCell& cell : cells_) {
      const std::vector<Shape> shapes = shapes_in(cell);
      AtNodes f = {};
      for (std::size_t k = 0; k < shapes.size(); ++k) {
        const std::size_t p = cell.row(k);
        const Vec<Dim> b_p = b(p);
        for (std::size_t c = 0; c < Shape::nodes; ++c)
          for (std::size_t i = 0; i < Dim; ++i)
            f[c][i] += state_.particles.mass(p) * b_p[i] * shapes[k].N[c];
      }
      add_to_unknowns(cell, f, loads_);
    }
  }

  /// sym(grad u), grad u = sum_I u_I (x) grad N_I: nothing turns.
  static Mat<Dim> strain(const Shape& shape, const AtNodes& u) {
    Mat<Dim> e = {};
    for (std::size_t c = 0; c < Shape::nodes; ++c)
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j)
          e[i][j] += 0.5 * (u[c][i] * shape.dN[c][j] + u[c][j] * shape.dN[c][i]);
    return e;
  }

  /// Lets the stresses of a cell's points follow displacements of its nodes.  Returns their force
  /// on these, N.
  AtNodes respond(const Cell& cell, const std::vector<Shape>& shapes, const AtNodes& u,
                  std::span<SymTensor<Dim>> tau, bool yields) const {
    // What a point's value lacks to the mean of the cell, whose points come in order.
    const auto excess = [&](std::size_t k, auto&& value) {
      if (!state_.averages_volume) return 0.0;
      std::size_t next = 0;
      return cell_mean(state_, cell, [&](std::size_t) { return value(next++); }) - value(k);
    };
    std::vector<Mat<Dim>> e;
    e.reserve(shapes.size());
    for (const Shape& shape : shapes) e.push_back(strain(shape, u));
    const auto divergence = [&](std::size_t k) {
      Real sum = 0.0;
      for (std::size_t i = 0; i < Dim; ++i) sum += e[k][i][i];
      return sum;
    };
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const MaterialModel& material = materials_[state_.particles.material[cell.row(k)]];
      const auto update = [&](const auto& law) {
        Real gap = 0.0;
        update_stress<Dim, Real>(
            tau[k], gap, 0.0, e[k], excess(k, divergence), 1.0, material.moduli,
            law_in_step<Real>(law, 0.0, std::numeric_limits<Real>::infinity()));
      };
      if (yields)
        std::visit(update, material.update);
      else
        update(ElasticUpdate{});
    }

    AtNodes f = {};
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const Real V0 = state_.particles.V0[cell.row(k)];
      const Real pressure =
          excess(k, [&](std::size_t at) { return trace<Dim, Real>(tau[at]) * (1.0 / 3.0); });
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j) {
          const Real t = tau[k][component<Dim>(static_cast<int>(i), static_cast<int>(j))] +
                         (i == j ? pressure : 0.0);
          for (std::size_t c = 0; c < Shape::nodes; ++c) f[c][i] -= V0 * t * shapes[k].dN[c][j];
        }
    }
    return f;
  }

  /// A column of a cell's stiffness is the force against one unit of displacement.
  void assemble(SparseSystem& stiffness) const {
    for (const OccupiedCell& cell : cells_) {
      const std::vector<Shape> shapes = shapes_in(cell);
      for (std::size_t c = 0; c < Shape::nodes; ++c)
        for (std::size_t i = 0; i < Dim; ++i) {
          const Unknown& column = unknown(cell, c, i);
          if (column.sign == 0.0) continue;
          AtNodes u = {};
          u[c][i] = column.sign;
          std::vector<SymTensor<Dim>> tau(shapes.size(), SymTensor<Dim>{});
          const AtNodes f = respond(cell, shapes, u, tau, false);
          for (std::size_t at = 0; at < Shape::nodes; ++at)
            for (std::size_t j = 0; j < Dim; ++j)
              if (const Unknown& row = unknown(cell, at, j); row.sign != 0.0)
                stiffness.add(row.index, column.index, -row.sign * f[at][j]);
        }
    }
    stiffness.prepare();
  }

  /// Lets all stresses follow, and finds what is then left of the loads.
  void follow(const Unknowns& q, bool yields) {
    std::vector<AtNodes> forces(cells_.size());
    const auto n = static_cast<std::int64_t>(cells_.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t k = 0; k < n; ++k) {
      const OccupiedCell& cell = cells_[static_cast<std::size_t>(k)];
      forces[static_cast<std::size_t>(k)] =
          respond(cell, shapes_in(cell), displacements(cell, q),
                  std::span(tau_).subspan(cell.first_point, cell.count), yields);
    }
    unbalanced_ = loads_;
    for (std::size_t k = 0; k < cells_.size(); ++k) // in one order for any threads
      add_to_unknowns(cells_[k], forces[k], unbalanced_);
  }

  /// Until what is left of the loads is within the tolerance, or would not be in time at the
  /// present pace.  Returns it.
  Real balance(const SparseSystem& stiffness, const Rule& rule) {
    std::vector<Real> left = {norm(unbalanced_) / load_};
    for (int k = 1; left.back() > rule.tolerance && k <= rule.most; ++k, ++iterations_) {
      follow(stiffness.solve(unbalanced_), rule.yields);
      left.push_back(norm(unbalanced_) / load_);
      if (k < rule.window) continue;
      const Real pace = left.back() / left[static_cast<std::size_t>(k - rule.window)];
      if (left.back() * std::pow(pace, (rule.most - k) / rule.window) > rule.tolerance) break;
    }
    return left.back();
  }

  static Real norm(const Unknowns& f) {
    Real sum = 0.0;
    for (const Real component : f) sum += component * component;
    return std::sqrt(sum);
  }

  [[noreturn]] void refuse(Real left, const Rule& rule) const {
    std::ostringstream text;
    text.precision(3);
    text << "method.initial_stress: no static equilibrium: " << 100.0 * left
         << " % of the loads at time 0 are left without balance after " << iterations_
         << " iterations " << rule.what << ": " << rule.reason
         << ", or leave the key out and let gravity rise in a [[stage]]";
    throw SetupError(text.str());
  }

  State<Dim, Shape>& state_;
  const std::vector<MaterialModel>& materials_;
  std::vector<OccupiedCell> cells_;
  std::vector<SymTensor<Dim>> tau_; ///< Pa, cell after cell
  std::vector<std::array<Unknown, Dim>> of_node_;
  int unknowns_ = 0;
  Unknowns loads_, unbalanced_; ///< N
  Real load_ = 0.0;             ///< N
  int iterations_ = 0;
};

} // namespace scarp
