// A run: material points, background grid, one time step after another.
#pragma once

#include "core/error.hpp"
#include "core/phases.hpp"
#include "core/scene.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace scarp {

/// Where the energy is, J (J/m in plane strain).  The work and the losses count from the run's
/// beginning:
///   gravity_work = change of (kinetic + strain) + plastic + damping + wall_friction + scheme_loss.
/// scheme_loss is what is left over: what the transfer between points and grid and the time
/// integration take.
struct Energies {
  /// Of the points; with affine transfers also of the gradients around them (core/affine.hpp).
  double kinetic = 0.0;
  /// Of the nodes: without the part of the points' velocities that the grid does not see and that
  /// moves nothing.
  double grid_kinetic = 0.0;
  double strain = 0.0;
  double gravitational = 0.0; ///< - sum m b . x with the present body force b
  double gravity_work = 0.0;  ///< of the body forces as they were, stage by stage
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

  /// One time step, which goes neither beyond `until` (s) nor, unless it is the last one, beyond
  /// the present stage.  Returns the step, s.
  /// Throws std::invalid_argument if these are not ahead, RunError when a point leaves the grid,
  /// turns inside out or is no number any more.
  virtual double step(double until) = 0;

  /// Who is told of the end of every phase from now on; null: nobody.  It has to outlive the steps
  /// it watches, and changes nothing in them.
  void watch(PhaseWatch* watch) { watch_ = watch; }

  virtual int dimension() const = 0;
  virtual double time() const = 0; ///< s
  virtual long steps() const = 0;
  virtual std::size_t points() const = 0;
  virtual std::size_t cells() const = 0; ///< of the whole grid
  virtual std::size_t occupied_cells() const = 0;
  /// Bytes taken between steps by what grows with the points or the grid.
  virtual std::size_t memory() const = 0;
  virtual bool waits_for_gate() const = 0; ///< whether a gate has still to open

  virtual const Stage& stage() const = 0; ///< the present one
  virtual double stage_end() const = 0;   ///< s, when it ends at the latest
  virtual bool in_last_stage() const = 0;
  /// Begins the next stage at the present time.  Throws std::logic_error in the last one.
  virtual void next_stage() = 0;

  virtual double stable_time_step() const = 0; ///< s, of the present state
  virtual Energies energies() const = 0;
  virtual double front() const = 0; ///< m, largest x of a point of Output::front_regions
  virtual std::vector<PlanLine> plan() const = 0;

  /// m, x y z of every point; y = 0 in plane strain.
  virtual std::vector<double> positions() const = 0;
  /// A field of core/fields.hpp, point by point.
  virtual std::vector<double> field(const std::string& name) const = 0;
  /// The material point nearest to a place at time 0.
  virtual std::size_t nearest_point(const std::array<double, 3>& place) const = 0;

 protected:
  void done(Phase phase) const {
    if (watch_) watch_->end_of(phase);
  }

 private:
  PhaseWatch* watch_ = nullptr;
};

/// The state of a run at one moment, point by point in the order of their creation.
struct Snapshot {
  double time = 0.0; ///< s
  long steps = 0;
  std::vector<double> position;          ///< m, x y z
  std::vector<double> displacement;      ///< m, x y z
  std::vector<double> velocity;          ///< m/s, x y z
  std::vector<double> stress;            ///< Pa, Cauchy, xx yy zz xy yz xz
  std::vector<double> volume;            ///< m3
  std::vector<double> initial_volume;    ///< m3
  std::vector<double> plastic_strain;    ///< -
  std::vector<double> gap;               ///< -
  std::vector<double> velocity_gradient; ///< 1/s, xx xy xz yx yy yz zx zy zz
};

/// At time 0, or at the beginning of the stage that begins from another run's state, `start`.
/// Throws SetupError, also if there is such a stage and no state, or one of other points.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Snapshot* start = nullptr);

} // namespace scarp
