// What to simulate: one plain value that a scene file, a test or another program fills in.
// Every quantity is SI; every angle in the interface is in degrees.
//
// Axes: x to the right, y into the page, z up.  In plane strain (dimension 2) y is the axis that is
// neither computed nor stored; arrays of three then carry an unused middle entry.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace scarp {

/// When stress is updated within a step: before the momentum (USF), after it with the nodal
/// velocities of the first mapping (USL), or after it with the points' updated momenta mapped to
/// the grid again (MUSL; Sulsky, Zhou & Schreyer 1995, Comput. Phys. Commun. 87:236).
enum class Scheme { usf, usl, musl };

/// Which Drucker-Prager cone stands for Mohr-Coulomb: in the pi plane inscribed ('+') or
/// circumscribed ('-'), or the match in plane strain.
enum class Cone { inscribed, circumscribed, plane_strain };

/// What a side of the domain does to the nodes on it.
/// fixed: no velocity; symmetry: no normal velocity; free: nothing;
/// friction: no velocity into the wall, Coulomb friction along it.
enum class WallKind { fixed, symmetry, free, friction };

struct Wall {
  WallKind kind = WallKind::free;
  double friction_coefficient = 0.0; ///< -, used by WallKind::friction only
};

/// A plane x = position or z = position (axis 0 or 2; 1 in 3-D) that acts as a symmetry plane until
/// release_time.  It must lie on a grid plane.
struct Gate {
  std::string name;
  int axis = 0;              ///< 0 = x, 1 = y, 2 = z
  double position = 0.0;     ///< m
  double release_time = 0.0; ///< s
};

struct LinearElastic {};

/// What becomes of the gap that opens when material is stretched at the tension cut-off.
/// forgotten: stress returns as soon as the stretching ends, as in most published codes; each
/// opening and closing then leaves the material a little larger. remembered: the gap has to close
/// first; see core/drucker_prager.hpp.
enum class Opening { forgotten, remembered };

/// What strength and dilation become with the equivalent plastic strain; see
/// core/evolving_strength.hpp. Infinity: as at first.
struct Softening {
  double cohesion = std::numeric_limits<double>::infinity();       ///< Pa
  double friction_angle = std::numeric_limits<double>::infinity(); ///< degrees
  double dilation_angle = std::numeric_limits<double>::infinity(); ///< degrees
  double peak_strain = 0.0; ///< -, plastic strain from which on they change
  /// -, plastic strain at which they have changed; infinity: they do not
  double residual_strain = std::numeric_limits<double>::infinity();
};

/// Drucker-Prager with a tension cut-off, non-associated; see core/drucker_prager.hpp.
struct DruckerPrager {
  double cohesion = 0.0;       ///< Pa
  double friction_angle = 0.0; ///< degrees
  double dilation_angle = 0.0; ///< degrees
  Cone cone = Cone::inscribed;
  /// Pa, largest mean stress (tension positive); the apex of the cone bounds it from above, so
  /// infinity means "at the apex".
  double tension_cutoff = std::numeric_limits<double>::infinity();
  Opening opening = Opening::forgotten;
  Softening residual;

  double rate_strengthening = 0.0; ///< -, growth of the cone's slope with the inertial number
  /// -, the most that the slope grows by
  double rate_strengthening_limit = std::numeric_limits<double>::infinity();
  double grain_diameter = 0.0; ///< m, in the inertial number

  /// The law of the residual state.
  DruckerPrager at_residual() const;
  /// Whether strength depends on plastic strain or on rate.
  bool evolves() const {
    return residual.residual_strain < std::numeric_limits<double>::infinity() ||
           rate_strengthening * grain_diameter > 0.0;
  }
};

struct Material {
  std::string name;
  double density = 0.0;        ///< kg/m3, before loading
  double youngs_modulus = 0.0; ///< Pa
  double poissons_ratio = 0.0; ///< -
  std::variant<LinearElastic, DruckerPrager> law;
};

/// A body part: a polygon in the x-z plane, in 3-D extruded along y.  A point belongs to the first
/// region that holds it.
struct Region {
  std::string name;
  std::string material;                       ///< Material::name
  std::vector<std::array<double, 2>> polygon; ///< m, (x, z), simple, either sense of rotation
  std::array<double, 2> depth = {0.0, 0.0};   ///< m, y from .. to; used in 3-D only
  std::array<double, 3> velocity = {0, 0, 0}; ///< m/s at time 0
};

struct Grid {
  int dimension = 2;                       ///< 2: plane strain, 3: full
  double cell_size = 0.0;                  ///< m
  std::array<double, 3> lower = {0, 0, 0}; ///< m; a multiple of cells lies between lower and upper
  std::array<double, 3> upper = {0, 0, 0}; ///< m
  int points_per_cell = 2;                 ///< along each axis: the lattice that regions fill
  /// walls[axis][0] the lower side, walls[axis][1] the upper side; axis 1 is unused in plane
  /// strain.
  std::array<std::array<Wall, 2>, 3> walls = {};
};

/// Shape functions of the grid: linear; uniform GIMP (core/gimp_shape.hpp); quadratic B-splines
/// (core/spline_shape.hpp).
enum class ShapeFunctions { linear, gimp, bspline };

/// What points and nodes exchange.  flip: velocities, a blend of FLIP and PIC.  apic: velocities
/// and their gradients around the points, no FLIP.  aflip: these, a blend of FLIP and APIC
/// (core/affine.hpp).
enum class VelocityTransfer { flip, apic, aflip };

/// The rate of volume of a point: its own, or the mean of its cell (core/stress_pass.hpp).
enum class VolumeRate { point, cell_average };

/// The stress at time 0.  equilibrium: that which bears the loads of time 0
/// (core/static_equilibrium.hpp).
enum class InitialStress { none, equilibrium };

/// Of what points and nodes carry.  Positions, time and energies are double in both.
enum class Precision { double_precision, single };

/// Combinations of the options of Method.  fidelity: as published for landslides (linear functions,
/// MUSL, FLIP; Wu 2017). accurate: quadratic B-splines and AFLIP, which hardly fail (README,
/// "Stress tests") and converge (README, "Which method").
enum class Preset { fidelity, accurate };

struct Method {
  Preset preset = Preset::fidelity; ///< that the rest started from; has no effect of its own
  Scheme scheme = Scheme::musl;
  ShapeFunctions shape = ShapeFunctions::linear;
  VolumeRate volume_rate = VolumeRate::point;
  VelocityTransfer transfer = VelocityTransfer::flip;
  Precision precision = Precision::double_precision;
  InitialStress initial_stress = InitialStress::none;
  /// Part of FLIP in the velocity update of a step with a CFL number of 0.3 (flip_of_step,
  /// core/time_step.hpp), the rest is PIC; no part of it in VelocityTransfer::apic.
  double flip = 1.0;
  double affine_flip = 0.5;   ///< the same of aflip
  double local_damping = 0.0; ///< Cundall's non-viscous damping, 0 .. 1
  /// The same while a gate has still to open, so that what it holds comes to rest; the larger of
  /// the two counts.
  double settling_damping = 0.0;
};

struct Timing {
  double end_time = 0.0;        ///< s; unused where there are stages
  double output_interval = 0.0; ///< s between frames
  /// s between rows of the history, which take the first step at or after it; 0: a tenth of
  /// output_interval.
  double history_interval = 0.0;
  double cfl = 0.3;                                               ///< part of the critical step
  double max_time_step = std::numeric_limits<double>::infinity(); ///< s
  /// The run, or a stage until rest, ends once, after the last gate has opened, the kinetic energy
  /// of the nodes (Energies::grid_kinetic) has stayed below this part of its peak for
  /// rest_duration; 0 = never.
  double rest_energy_fraction = 0.0;
  double rest_duration = 0.0; ///< s
};

/// A factor that changes with time: linear between its points, constant before and after them.
struct Ramp {
  std::vector<std::array<double, 2>> points = {{0.0, 1.0}}; ///< s, -; times ascending

  double at(double time) const;
  double largest() const; ///< size
  bool constant() const { return points.size() == 1; }
};

/// A part of the run with its own loads and materials.  Stress and state go over from one stage to
/// the next.
struct Stage {
  std::string name;
  double duration = 0.0;       ///< s
  std::optional<double> start; ///< s; if given, it has to be the end of the stage before
  /// Ends before its duration is over, once the mass is at rest (Timing::rest_energy_fraction).
  bool until_rest = false;
  Ramp gravity;                           ///< multiple of Scene::gravity; s since the stage began
  std::map<std::string, Ramp> body_force; ///< by region: a further multiple of its own gravity
  std::map<std::string, std::string> material; ///< by region, during this stage; else its own
  /// Where the state to begin from is kept; the stages before this one are then left out.  Empty:
  /// the state of the stage before.
  std::string begin_from;

  /// Name of what a region is made of.
  const std::string& material_of(const Region& region) const;
  /// The largest multiple of Scene::gravity that a region bears.
  double largest_gravity(const Region& region) const;
};

/// A point to be followed in history.csv: the material point nearest to this place at time 0.
struct Monitor {
  std::string name;
  std::array<double, 3> position = {0, 0, 0}; ///< m
};

struct Output {
  std::vector<std::string> fields; ///< names of core/fields.hpp; empty: all
  /// Regions whose largest x is the front; empty: all.
  std::vector<std::string> front_regions;
};

/// m/s2 at a place (m, x y z; y = 0 in plane strain) and a time (s).  Several threads call it.
using BodyForceField = std::function<std::array<double, 3>(const std::array<double, 3>&, double)>;

struct Scene {
  std::string title;
  Grid grid;
  Timing timing;
  Method method;
  std::array<double, 3> gravity = {0.0, 0.0, -9.81}; ///< m/s2
  /// Beside gravity, for programs: scene files have no key for it.  Energies leave its work out, so
  /// that scheme_loss is then not what the scheme loses.
  BodyForceField body_force;
  std::vector<Material> materials;
  std::vector<Region> regions;
  std::vector<Gate> gates;
  std::vector<Stage> stages; ///< empty: one, to Timing::end_time
  std::vector<Monitor> monitors;
  Output output;
};

Method method_of(Preset preset);

/// The CFL number where a scene gives none: 0.7 with affine transfers, whose step is short enough
/// wherever the points lie (core/time_step.hpp); 0.3 with others: at 0.7 USF gains energy and USL
/// throws points (tests/verification/elastic_bar.cpp and rotating_disc.cpp with that number).
double usual_cfl(const Method& method);

/// A scene's stages; of a scene without any, the one that its timing describes.
std::vector<Stage> stages_of(const Scene& scene);

/// s, when the run ends at the latest if it began at time 0: that of all stages.
double end_time(const Scene& scene);

} // namespace scarp
