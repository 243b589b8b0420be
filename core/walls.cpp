#include "core/walls.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <limits>

namespace scarp {

namespace {

constexpr std::uint8_t bit(std::size_t i) { return static_cast<std::uint8_t>(1U << i); }
template <int Dim> constexpr std::uint8_t all_components = (1U << Dim) - 1U;

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
      if (grid.layout != NodeLayout::spline) continue;
      if (wall.kind == WallKind::fixed) mirrors_.push_back({axis, side, all_components<Dim>});
      if (wall.kind == WallKind::symmetry) mirrors_.push_back({axis, side, bit(axis)});
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
      if (of.node / grid_->node_stride[axis] % grid_->nodes[axis] != outer) continue;
      of.node += (inner - outer) * grid_->node_stride[axis];
      of.sign *= outer == inner ? 0.0 : sign;
      return;
    }
  };
  for (const Mirror& mirror : mirrors_) reflect(mirror.axis, mirror.side, mirror.sign(component));
  for (const Friction& friction : friction_)
    if (friction.axis == component) reflect(friction.axis, friction.side, -1.0);
  if (held_[static_cast<std::size_t>(of.node)] >> component & 1U) of.sign = 0.0;
  return of;
}

template <int Dim> void Walls<Dim>::hold_nodes(double time) {
  held_.assign(static_cast<std::size_t>(grid_->node_count), 0);
  const auto place = [this](int node, std::size_t axis) {
    return node / grid_->node_stride[axis] % grid_->nodes[axis];
  };
  const auto hold = [&](std::size_t axis, int plane, std::uint8_t components) {
    const auto [first, last] = grid_->nodes_of_plane(axis, plane);
    for (int node = 0; node < grid_->node_count; ++node)
      if (place(node, axis) >= first && place(node, axis) <= last)
        held_[static_cast<std::size_t>(node)] |= components;
  };

  for (const Gate& gate : gates_) {
    if (gate.release_time <= time) continue;
    const std::size_t axis = grid_axis<Dim>(gate.axis);
    hold(axis, static_cast<int>(std::lround(grid_->scaled(gate.position, axis))), bit(axis));
  }
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      const WallKind kind = sides_[axis][side].kind;
      if (grid_->layout == NodeLayout::spline) {
        // The image of what a gate holds is held.
        if (kind == WallKind::free || kind == WallKind::friction) continue;
        const auto [outer, inner] = grid_->side_layers(axis, side).front();
        for (int node = 0; node < grid_->node_count; ++node)
          if (place(node, axis) == outer)
            held_[static_cast<std::size_t>(node)] |=
                held_[static_cast<std::size_t>(node + (inner - outer) * grid_->node_stride[axis])];
      } else {
        const int plane = side == 0 ? 0 : grid_->cells[axis];
        if (kind == WallKind::fixed) hold(axis, plane, all_components<Dim>);
        if (kind == WallKind::symmetry) hold(axis, plane, bit(axis));
      }
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
