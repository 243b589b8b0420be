// The parts of a step, for a program that measures them: the solver itself knows no clock.
#pragma once

#include <array>
#include <cstddef>

namespace scarp {

/// In the order of a MUSL step.  A USF step passes through scatter and nodes twice.
enum class Phase {
  sort,    ///< gates, loads, points to cells
  scatter, ///< P2G: points to cells
  nodes,   ///< cells to nodes, momentum, walls
  gather,  ///< G2P: nodes to points; MUSL: in the same sweep the new momenta back to cells
  remap,   ///< MUSL: cells to nodes once more
  stress,  ///< strain rates, laws, and motion of the points
};

inline constexpr std::array<const char*, 6> phase_names = {"sort",   "scatter", "nodes",
                                                           "gather", "remap",   "stress"};
inline constexpr std::size_t phase_count = phase_names.size();

constexpr const char* name_of(Phase phase) { return phase_names[static_cast<std::size_t>(phase)]; }

/// Is told when a phase of a step has ended.
class PhaseWatch {
 public:
  PhaseWatch() = default;
  PhaseWatch(const PhaseWatch&) = delete;
  PhaseWatch& operator=(const PhaseWatch&) = delete;
  virtual ~PhaseWatch() = default;

  virtual void end_of(Phase phase) = 0;
};

} // namespace scarp
