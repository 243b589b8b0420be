// A run: material points, background grid, one time step after another.
#pragma once

#include "core/error.hpp"
#include "core/scene.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace scarp {

/// Where the energy is, J (J/m in plane strain).  The work and the losses count from time 0:
///   gravity_work = change of (kinetic + strain) + plastic + damping + wall_friction + scheme_loss.
/// scheme_loss is what is left over: what the transfer between points and grid and the time
/// integration take.
struct Energies {
  double kinetic = 0.0;
  /// Of the nodes: without the part of the points' velocities that the grid does not see and that
  /// moves nothing.
  double grid_kinetic = 0.0;
  double strain = 0.0;
  double gravitational = 0.0; ///< - sum m g . x
  double gravity_work = 0.0;
  double plastic = 0.0;
  double damping = 0.0;
  double wall_friction = 0.0;
  double scheme_loss = 0.0;
};

/// What a scene asks for and what it does without, for the user to read.
struct PlanLine {
  std::string what;
  std::string how;
};

/// Values are given in the order of the points' creation.  Not copyable; one thread uses it, and it
/// uses OpenMP's threads: the results are the same to the bit for any number of them.
class Simulation {
 public:
  Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  virtual ~Simulation() = default;

  /// One time step, which does not go beyond `until` (s).  Returns the step, s.
  /// Throws std::invalid_argument if `until` is not ahead, RunError when a point leaves the grid,
  /// turns inside out or is no number any more.
  virtual double step(double until) = 0;

  virtual int dimension() const = 0;
  virtual double time() const = 0; ///< s
  virtual long steps() const = 0;
  virtual std::size_t points() const = 0;
  virtual std::size_t cells() const = 0; ///< of the whole grid
  virtual std::size_t occupied_cells() const = 0;
  virtual bool waits_for_gate() const = 0;     ///< whether a gate has still to open
  virtual double stable_time_step() const = 0; ///< s, of the present state
  virtual Energies energies() const = 0;
  virtual double front() const = 0; ///< m, largest x of a point
  virtual std::vector<PlanLine> plan() const = 0;

  /// m, x y z of every point; y = 0 in plane strain.
  virtual std::vector<double> positions() const = 0;
  /// A field of core/fields.hpp, point by point.
  virtual std::vector<double> field(const std::string& name) const = 0;
  /// The material point nearest to a place at this moment.
  virtual std::size_t nearest_point(const std::array<double, 3>& place) const = 0;
};

/// Throws SetupError.
std::unique_ptr<Simulation> make_simulation(const Scene& scene);

} // namespace scarp
