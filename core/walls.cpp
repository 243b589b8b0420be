#include "core/walls.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <limits>

namespace scarp {

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
  rebuild(0.0);
  if (grid.layout == NodeLayout::spline) find_mirrors();
}

template <int Dim> void Walls<Dim>::open_gates(double time) {
  const auto due = [time](const Gate& gate) { return gate.release_time <= time; };
  if (!std::any_of(gates_.begin(), gates_.end(), due)) return;
  gates_.erase(std::remove_if(gates_.begin(), gates_.end(), due), gates_.end());
  rebuild(time);
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
  const auto n = static_cast<std::size_t>(node);
  bool held = held_[n] >> component & 1U;
  for (std::size_t k = 0; k < friction_sides_.size(); ++k)
    held = held || ((rubs_[n] >> k & 1U) && friction_sides_[k].axis == component);
  return {node, held ? 0.0 : 1.0};
}

template <int Dim> void Walls<Dim>::rebuild(double time) {
  held_.assign(static_cast<std::size_t>(grid_->node_count), 0);
  rubs_.clear();
  friction_sides_.clear();

  const auto for_each_node_on = [this](std::size_t axis, int plane, auto&& visit) {
    const auto [first, last] = grid_->nodes_of_plane(axis, plane);
    for (int node = 0; node < grid_->node_count; ++node) {
      const int along = node / grid_->node_stride[axis] % grid_->nodes[axis];
      if (along >= first && along <= last) visit(static_cast<std::size_t>(node));
    }
  };
  const auto bit = [](std::size_t i) { return static_cast<std::uint8_t>(1U << i); };

  for (std::size_t axis = 0; axis < Dim; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Wall& wall = sides_[axis][side];
      const int plane = side == 0 ? 0 : grid_->cells[axis];
      switch (wall.kind) {
      case WallKind::free:
        break;
      case WallKind::fixed:
        for_each_node_on(axis, plane, [&](std::size_t n) { held_[n] = (1U << Dim) - 1U; });
        break;
      case WallKind::symmetry:
        for_each_node_on(axis, plane, [&](std::size_t n) { held_[n] |= bit(axis); });
        break;
      case WallKind::friction:
        rubs_.resize(held_.size(), 0);
        for_each_node_on(axis, plane,
                         [&](std::size_t n) { rubs_[n] |= bit(friction_sides_.size()); });
        friction_sides_.push_back({axis, side == 0 ? 1.0 : -1.0, wall.friction_coefficient});
        break;
      }
    }
  }
  for (const Gate& gate : gates_) {
    if (gate.release_time <= time) continue;
    const std::size_t axis = grid_axis<Dim>(gate.axis);
    const int plane = static_cast<int>(std::lround(grid_->scaled(gate.position, axis)));
    for_each_node_on(axis, plane, [&](std::size_t n) { held_[n] |= bit(axis); });
  }
}

/// One mirror for each set of sides that a node is next to.
template <int Dim> void Walls<Dim>::find_mirrors() {
  constexpr std::size_t sets = power(4, Dim); // lower, upper or both, along each axis
  mirrors_.assign(sets, {});
  for (std::size_t set = 0; set < sets; ++set)
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      if (set >> 2 * axis & 1U) mirrors_[set].lower[axis] = grid_->odd[axis][0];
      if (set >> 2 * axis & 2U) mirrors_[set].upper[axis] = grid_->odd[axis][1];
    }
  bool any = false;
  for (const auto& sides : grid_->odd) any = any || sides[0] != 0 || sides[1] != 0;
  if (!any) return;
  next_to_mirror_.assign(held_.size(), 0);
  for (int node = 0; node < grid_->node_count; ++node) {
    std::uint8_t& set = next_to_mirror_[static_cast<std::size_t>(node)];
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const int along = node / grid_->node_stride[axis] % grid_->nodes[axis];
      if (along == 1 && grid_->odd[axis][0] != 0) set |= static_cast<std::uint8_t>(1U << 2 * axis);
      if (along == grid_->nodes[axis] - 2 && grid_->odd[axis][1] != 0)
        set |= static_cast<std::uint8_t>(2U << 2 * axis);
    }
  }
}

template <int Dim> void Walls<Dim>::rub(int node, Vec<Dim>& v, bool tangential) const {
  const std::uint8_t mask = rubs_[static_cast<std::size_t>(node)];
  for (std::size_t k = 0; k < friction_sides_.size(); ++k) {
    if (!(mask >> k & 1U)) continue;
    const Side& side = friction_sides_[k];
    const Real into = -side.inward * v[side.axis];
    if (into <= 0.0) continue;
    v[side.axis] = 0.0;
    if (!tangential) continue;
    Real slip2 = 0.0;
    for (const Real component : v) slip2 += component * component;
    const Real slip = std::sqrt(slip2);
    const Real kept = slip > 0.0 ? std::max(0.0, 1.0 - side.friction * into / slip) : 0.0;
    for (Real& component : v) component *= kept;
  }
}

template class Walls<2>;
template class Walls<3>;

} // namespace scarp
