// What the domain's sides and the gates do to nodal velocities.
#pragma once

#include "core/grid_index.hpp"
#include "core/memory.hpp"
#include "core/nodes.hpp"
#include "core/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace scarp {

/// What sides and gates do to velocities.
///
/// Linear functions and GIMP have nodes on the sides: fixed and symmetry sides hold them at 0, both
/// in the velocity before and after the step, so that they exchange no momentum with the FLIP
/// increment.  B-splines have a layer of nodes outside and one inside, whose mean is the velocity
/// on the side: there fixed sides make every component odd (v_outer = - v_inner), symmetry sides
/// the normal one odd and the others even, which is the body and its mirror image.  The two then
/// move as one, with the sum of their lumped masses: the projection of the motion onto what the
/// side allows that keeps the kinetic energy's metric.  A projection never has a higher frequency
/// than what it projects, so the step's bound (core/time_step.hpp) holds at sides as it does
/// inside.
///
/// Friction sides act as an impulse once a step, in the same metric.  Gates hold nodes.
template <int Dim> class Walls {
 public:
  /// Throws SetupError for a gate that is not on a plane of the grid.
  Walls(const Scene& scene, const GridIndex<Dim>& grid);

  /// Opens the gates whose time has come.
  void open_gates(double time);

  /// Time of the next opening after `time`, or infinity.
  double next_opening(double time) const;

  /// Takes the constrained components of v away.
  void constrain(int node, Vec<Dim>& v) const {
    const std::uint8_t mask = held_[static_cast<std::size_t>(node)];
    for (std::size_t i = 0; i < Dim; ++i)
      if (mask >> i & 1U) v[i] = 0.0;
  }

  /// Whether a component of one of `count` nodes in a row is held.
  bool hold(int first, std::size_t count) const {
    unsigned any = 0;
    const auto from = static_cast<std::size_t>(first);
    for (std::size_t k = from; k < from + count; ++k) any |= held_[k];
    return any != 0;
  }

  /// A component of a node's displacement: `sign` times that of `node`; sign 0: held at 0.
  struct DegreeOfFreedom {
    int node;
    Real sign;
  };
  /// For a body at rest (core/static_equilibrium.hpp).  Friction sides then hold the normal
  /// component both ways, also where the body would come off, and nothing along them.
  DegreeOfFreedom degree_of_freedom(int node, std::size_t component) const;

  /// A side whose outer nodes are images of the inner ones; a node on it is its own image.
  struct Mirror {
    std::size_t axis, side;
    std::uint8_t odd; ///< bit i: component i, else even

    Real sign(std::size_t component) const { return odd >> component & 1U ? -1.0 : 1.0; }
  };
  /// Those that have nodes on both sides.
  std::span<const Mirror> mirrors() const {
    return grid_->layout == NodeLayout::spline ? std::span<const Mirror>(mirrors_)
                                               : std::span<const Mirror>();
  }

  /// Coulomb's law along a side: the impulse that stops the motion into it allows a tangential
  /// impulse of at most `coefficient` times it.
  struct Friction {
    std::size_t axis, side;
    Real coefficient;

    /// The velocity on the side after the impulse; with no motion into it, the same.
    Vec<Dim> resist(Vec<Dim> v) const;
    /// Only the normal part, for velocities that are mapped again within the step.
    Vec<Dim> hold_back(Vec<Dim> v) const;
  };
  const std::vector<Friction>& friction() const { return friction_; }

  /// Bytes of what is kept by node.
  std::size_t memory() const { return bytes_of(held_); }

 private:
  void hold_nodes(double time);

  const GridIndex<Dim>* grid_;
  std::array<std::array<Wall, 2>, Dim> sides_;
  std::vector<Gate> gates_;
  std::vector<std::uint8_t> held_; ///< by node: bit i, component i is held at 0
  std::vector<Mirror> mirrors_;    ///< by axis
  std::vector<Friction> friction_;
};

} // namespace scarp
