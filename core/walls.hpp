// What the domain's sides and the gates do to nodal velocities.
#pragma once

#include "core/grid_index.hpp"
#include "core/memory.hpp"
#include "core/nodes.hpp"
#include "core/scene.hpp"

#include <cstdint>
#include <vector>

namespace scarp {

/// Constraints by node.  Fixed and symmetry sides take velocity components away, both from the
/// velocity before and after the step, so that they exchange no momentum with the FLIP increment;
/// friction sides act as an impulse once a step.
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

  /// Whether anything below acts on one of `count` nodes in a row.
  bool touch(int first, std::size_t count) const {
    unsigned any = 0;
    const auto from = static_cast<std::size_t>(first);
    for (std::size_t k = from; k < from + count; ++k) any |= held_[k];
    if (!rubs_.empty())
      for (std::size_t k = from; k < from + count; ++k) any |= rubs_[k];
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

  /// Sides that hold the first control points of B-splines at 0 are mirrors in which a velocity is
  /// odd.  The control point next to such a side then moves with its image, and its inertia is that
  /// of both, its own and that of the held one: core/node_pass.hpp.
  struct Mirror {
    std::array<std::uint8_t, Dim> lower = {}; ///< by axis: bit i, component i is odd
    std::array<std::uint8_t, Dim> upper = {};
  };
  /// Of a node next to such sides, else null.
  const Mirror* mirror(int node) const {
    if (next_to_mirror_.empty()) return nullptr;
    const std::uint8_t which = next_to_mirror_[static_cast<std::size_t>(node)];
    return which == 0 ? nullptr : &mirrors_[which];
  }

  bool have_mirrors() const { return !next_to_mirror_.empty(); }

  /// Coulomb's law along friction sides: the impulse that stops the motion into the wall allows a
  /// tangential impulse of at most `friction_coefficient` times it.
  void resist(int node, Vec<Dim>& v) const {
    if (!rubs_.empty()) rub(node, v, true);
  }

  bool have_friction() const { return !rubs_.empty(); }

  /// Bytes of what is kept by node.
  std::size_t memory() const { return bytes_of(held_, rubs_, next_to_mirror_, mirrors_); }

  /// Only the normal part of `resist`, for velocities that are mapped again within the step.
  void hold_back(int node, Vec<Dim>& v) const {
    if (!rubs_.empty()) rub(node, v, false);
  }

 private:
  struct Side {
    std::size_t axis;
    Real inward; ///< +1 at the lower side, -1 at the upper side
    Real friction;
  };

  void rebuild(double time);
  void find_mirrors();
  void rub(int node, Vec<Dim>& v, bool tangential) const;

  const GridIndex<Dim>* grid_;
  std::array<std::array<Wall, 2>, Dim> sides_;
  std::vector<Gate> gates_;
  std::vector<std::uint8_t> held_; ///< by node: bit i, component i is held at 0
  std::vector<std::uint8_t> rubs_; ///< by node: bit k, friction side k; empty if there is none
  std::vector<Side> friction_sides_;
  std::vector<std::uint8_t> next_to_mirror_; ///< by node: index into mirrors_, 0: none
  std::vector<Mirror> mirrors_;
};

} // namespace scarp
