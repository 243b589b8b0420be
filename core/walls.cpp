#include "core/walls.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <limits>

namespace scarp {

namespace {

constexpr std::uint8_t bit(std::size_t i) { return static_cast<std::uint8_t>(1U << i); }

/// The components of the velocity that a side holds at 0, as bits.
template <int Dim> std::uint8_t held_components(WallKind kind, std::size_t axis) {
  switch (kind) {
  case WallKind::fixed:
    return (1U << Dim) - 1U;
  case WallKind::symmetry:
    return bit(axis);
  case WallKind::free:
  case WallKind::friction:
    break;
  }
  return 0;
}

} // namespace

template <int Dim>
Walls<Dim>::Walls(const Scene& scene, const GridIndex<Dim>& grid) : grid_(&grid) {
  for (int a = 0; a < Dim; ++a)
    sides_[static_cast<std::size_t>(a)] = scene.grid.walls[scene_axis<Dim>(a)];
  gates_ = scene.gates;
  for (const Gate& gate : gates_) {
    if (gate.axis < 0 || gate.axis > 2 || (Dim == 2 && gate.axis == 1))
      throw SetupError("gate '" + gate.name + "': its axis is none of the grid's");
    const std::size_t axis = grid_axis<Dim>(gate.axis);
    const Real plane = grid.scaled(gate.position, axis);
    if (!(plane >= -1e-6 && plane <= grid.cells[axis] + 1e-6) ||
        std::abs(plane - std::round(plane)) > 1e-6)
      throw SetupError("gate '" + gate.name + "': must lie on a plane of the grid");
  }
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      const Wall& wall = sides_[axis][side];
      if (wall.kind == WallKind::friction)
        friction_.push_back({axis, side, wall.friction_coefficient});
      if (const std::uint8_t odd = held_components<Dim>(wall.kind, axis))
        mirrors_.push_back({axis, side, odd});
    }
  hold_nodes(0.0);
}

template <int Dim> void Walls<Dim>::open_gates(double time) {
  const auto due = [time](const Gate& gate) { return gate.release_time <= time; };
  if (!std::any_of(gates_.begin(), gates_.end(), due)) return;
  gates_.erase(std::remove_if(gates_.begin(), gates_.end(), due), gates_.end());
  hold_nodes(time);
}

template <int Dim> double Walls<Dim>::next_opening(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Gate& gate : gates_)
    if (gate.release_time > time) next = std::min(next, gate.release_time);
  return next;
}

template <int Dim>
typename Walls<Dim>::DegreeOfFreedom Walls<Dim>::degree_of_freedom(int node,
                                                                   std::size_t component) const {
  DegreeOfFreedom of = {node, 1.0};
  const auto reflect = [&](std::size_t axis, std::size_t side, Real sign) {
    for (const auto& [outer, inner] : grid_->side_layers(axis, side)) {
      if (grid_->node_along(of.node, axis) != outer) continue;
      of.node += (inner - outer) * grid_->node_stride[axis];
      of.sign *= outer == inner ? 0.0 : sign;
      return;
    }
  };
  for (const Mirror& mirror : mirrors()) reflect(mirror.axis, mirror.side, mirror.sign(component));
  for (const Friction& friction : friction_)
    if (friction.axis == component) reflect(friction.axis, friction.side, -1.0);
  if (held_[static_cast<std::size_t>(of.node)] >> component & 1U) of.sign = 0.0;
  return of;
}

template <int Dim> void Walls<Dim>::hold_nodes(double time) {
  held_.assign(static_cast<std::size_t>(grid_->node_count), 0);
  // What hold(node) says is held of the nodes from first to last along an axis.
  const auto add = [&](std::size_t axis, int first, int last, const auto& hold) {
    for (int node = 0; node < grid_->node_count; ++node)
      if (const int along = grid_->node_along(node, axis); first <= along && along <= last)
        held_[static_cast<std::size_t>(node)] |= hold(node);
  };
  for (const Gate& gate : gates_) {
    if (gate.release_time <= time) continue;
    const std::size_t axis = grid_axis<Dim>(gate.axis);
    const auto plane = static_cast<int>(std::lround(grid_->scaled(gate.position, axis)));
    const auto [first, last] = grid_->nodes_of_plane(axis, plane);
    add(axis, first, last, [&](int) { return bit(axis); });
  }
  for (const Mirror& side : mirrors_)
    for (const auto& [outer, inner] : grid_->side_layers(side.axis, side.side)) {
      const int inwards = (inner - outer) * grid_->node_stride[side.axis];
      add(side.axis, outer, outer, [&](int node) {
        // The image of what a gate holds is held.
        return inwards == 0 ? side.odd : held_[static_cast<std::size_t>(node + inwards)];
      });
    }
}

template <int Dim> Vec<Dim> Walls<Dim>::Friction::hold_back(Vec<Dim> v) const {
  v[axis] = side == 0 ? std::max(v[axis], 0.0) : std::min(v[axis], 0.0);
  return v;
}

template <int Dim> Vec<Dim> Walls<Dim>::Friction::resist(Vec<Dim> v) const {
  const Real into = side == 0 ? -v[axis] : v[axis];
  if (into <= 0.0) return v;
  v[axis] = 0.0;
  Real slip2 = 0.0;
  for (const Real component : v) slip2 += component * component;
  const Real slip = std::sqrt(slip2);
  const Real kept = slip > 0.0 ? std::max(0.0, 1.0 - coefficient * into / slip) : 0.0;
  for (Real& component : v) component *= kept;
  return v;
}

template class Walls<2>;
template class Walls<3>;

} // namespace scarp
