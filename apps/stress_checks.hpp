// What has to hold in every run, however it is set up.  Every bound is one-sided, follows from
// balances that the continuum obeys, and stands here once.
//
// b: the largest body force of the scene (m/s2); F: the largest difference of its potential within
// the grid (m2/s2); v0: the largest speed at time 0; rho: density; c: the speed of P-waves.
//
// numbers   Positions, velocities, stresses, volumes and energies are finite.
//
// energy    Friction, damping and plastic flow only take energy, and an explicit scheme must not
//           give it: scheme_loss >= - energy_fraction P, with P = T(0) + max W the energy put in so
//           far, over all steps: a cut square's whole period is four steps or five.  Leapfrog knows
//           velocity and strain half a step apart: what it keeps is not T + U but v_n . M v_n+1 / 2
//           + U(x_n), with the velocities before and after the force at x_n. T + U of a mode of
//           frequency w swings about more than that, up to 1/(1 - w dt/2) times as much, so
//           energies are taken with this product (centred_loss).  They count from the one at time
//           0, which initial stresses may make smaller than 0.  Not larger: a side or damping that
//           stops a body within the first step would make it so, and nothing is lost before a run.
//           What is left is averaged over the last energy_window looks: operators change while
//           points move.
//
// losses    Damping, friction and plastic flow each take energy: none of them gives more than
//           energy_fraction P back.
//
// rest      The mean of scheme_loss must not fall either, once the nodes' kinetic energy has been
//           below 1e-3 of its peak for energy_window looks: from then on by at most rest_fraction
//           P.
//
// speed     A point moves freely at v = min(v0 + b t, sqrt(v0^2 + 2 F)).  A wave that brings v
//           leaves a free surface with 2 v.  Where a dense material presses a light one out or
//           throws it, all its pressure may become the light one's speed (Bernoulli):
//           sqrt(rho_max/rho_min).  A wave also presses across, with the part r = lambda/(lambda +
//           2 G) of its stress, which faces there let go with r v, and that once more along with
//           r^2 v; then nothing is left to let go.  So |v_p| <= 2 sqrt((1 + (d - 1) r^2)^2 + (d -
//           1) r^2) sqrt(rho_max/rho_min) v, with d the dimension.  (In one dimension 2 v: an
//           elastic square with nu = 0.4 that meets a smooth wall has points with 2.3, 2.6 and 2.7
//           v at 20, 40 and 80 cells, where this allows 3.2 v.)
//           Where a fixed or a friction side holds what moves along it, a wave of shear starts
//           there, and all its stress presses across, since sigma_xz = sigma_zx: r = 1.  (An
//           elastic block, 15 cells wide and 17 high, that starts at 14 degrees from a fixed base
//           has 2.5 v at its upper corner, and 3.3, 4.0, 4.4 and 5.0 v with cells halved again and
//           again: such a corner has no bound for ever finer cells.  This allows 4.5 v, enough for
//           bodies of the random scenes' few cells.)
//
// stress    Along a characteristic of the wave equation sigma +- rho c v changes only by the body
//           force, rho b times the path.  Two waves meet, along every axis at once; of the stress
//           of a plane wave K / (K + 4/3 G) is mean stress: |sigma_m| <= 2 max(1, d K / (K + 4/3
//           G)) max(rho c) v_max + stress_concentration max(rho) b L, with v_max the fastest point
//           up to now, L the sum of the body's extents and a factor for corners and for the linear
//           shape functions, whose stress jumps by about the stress itself as a point crosses a
//           cell.  sigma_m is the mean Kirchhoff stress, tau = J sigma, which the force holds with
//           a fixed weight.
//
// cut       These two are those of a wave as wide as a square of the lattice, the least that points
//           resolve.  A square that the body's outline cuts to the part a of its volume: struck by
//           a whole one of speed v it leaves with 2 v/(1 + a) (momentum and energy of two bodies);
//           the outline may cut along every axis, and then d such impacts follow each other, whole
//           to edge to corner, which together give most where all cut alike, by the part a^(1/d).
//           Pressed between them it is the tip of a horn: along one the power of a wave,
//           A sigma v, stays, so that sigma = rho c v grows as 1/sqrt(A).  Its speed may be (2/(1 +
//           a^(1/d)))^d, its stress 1/sqrt(a) times as large; but never so large that it alone has
//           more energy than there is: rho V0 v^2/2 and V0 sigma_m^2/2K are at most
//           (1 + energy_fraction) P.  v_max is then v by that.
//
// volume    log J = tau_m/K + gap + sqrt(3) q_psi e_p, with the equivalent plastic strain e_p: what
//           is pressed, open and dilated (core/stress_pass.hpp).  A dilation angle has no end: a
//           point that shears for ever, to and fro, dilates for ever, and only pressure answers.
//           But for that part, exp(sqrt(3) q_psi e_p), a point is not larger than the grid.  It is
//           not smaller than the stress bound presses it, since the others only add to J; so J >=
//           exp(- bound/K)/2, where 1/2 is for the higher orders of the steps' products.
//
// steps     The stable step is that of waves and of the fastest point (core/time_step.hpp), so a
//           run does not take more steps than c, the speed bound and b allow.
//
// leaving   A point may leave the grid at a free side only, not faster than `speed`.
#pragma once

#include "core/error.hpp"
#include "core/scene.hpp"
#include "core/simulation.hpp"

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scarp::apps {

constexpr double energy_fraction = 0.1;
constexpr double rest_fraction = 0.01;
constexpr std::size_t energy_window = 20; ///< looks
constexpr long steps_between_looks = 5;
constexpr double stress_concentration = 4.0;

/// What the bounds need of a scene.
struct StressLimits {
  double body_force = 0.0;    ///< b, m/s2
  double potential = 0.0;     ///< F, m2/s2
  double speed = 0.0;         ///< v0, m/s
  double density_ratio = 1.0; ///< rho_max/rho_min
  int dimension = 2;          ///< d
  double across = 1.0;        ///< the largest sqrt((1 + (d - 1) r^2)^2 + (d - 1) r^2), of speed
  double impedance = 0.0;     ///< max rho c, Pa s/m
  double waves = 1.0;         ///< max(1, d K / (K + 4/3 G))
  double weight = 0.0;        ///< max(rho) b L, Pa
  double bulk = 0.0;          ///< the smallest K, Pa
  double room = 0.0;          ///< of the grid, m3 (m2 in plane strain)
  double square = 0.0;        ///< of the lattice, whole: the same
  double stiffest = 0.0;      ///< the largest K, Pa
  double lightest = 0.0;      ///< the smallest density, kg/m3
  double dilation = 0.0;      ///< sqrt(3) q_psi, the largest
  double steps = 0.0;         ///< the most that the run may take

  double fastest(double time) const;         ///< m/s, of a point
  double stress(double largest_speed) const; ///< Pa

  /// How many times the stress of a whole square a cut one may have, 1/sqrt(a).
  double horn(double initial_volume) const;
  /// The same for the speed, (2/(1 + a^(1/d)))^d.
  double impact(double initial_volume) const;
  /// The same bounds for a cut square; `energy`: all there is, J (J/m in plane strain).
  double fastest_of(double initial_volume, double time, double energy) const;
  double stress_of(double initial_volume, double largest_speed, double energy) const;
};
StressLimits stress_limits(const Scene& scene);

/// What the checks look at: a run at one moment.
struct StressMoment {
  double time = 0.0; ///< s
  long steps = 0;
  Energies energies;
  std::vector<double> position;       ///< m, x y z
  std::vector<double> velocity;       ///< m/s, x y z
  std::vector<double> gradient;       ///< 1/s, of affine transfers, nine a point; else 0
  std::vector<double> mass;           ///< kg (kg/m in plane strain)
  std::vector<double> mean_stress;    ///< Pa, Cauchy
  std::vector<double> volume;         ///< m3 (m2 in plane strain)
  std::vector<double> initial_volume; ///< the same
  std::vector<double> plastic_strain; ///< -, e_p
};
StressMoment stress_moment(const Simulation& simulation);

/// J (J/m), scheme_loss of a moment with the kinetic energy v_n . M v_n+1 / 2 of it and the next
/// step, whose velocities and gradients are given.  h: m, of the cells; gradients count as with
/// B-splines (core/affine.hpp).
double centred_loss(const StressMoment& now, const std::vector<double>& next_velocity,
                    const std::vector<double>& next_gradient, double h);

/// A bound that does not hold.  For a lower bound value < bound, else value > bound.
struct StressFailure {
  std::string check; ///< a word of the list above
  double value = 0.0;
  double bound = 0.0;
  double time = 0.0; ///< s
  std::size_t point = 0;
  std::string what; ///< what the value is, with its unit
};

class StressChecks {
 public:
  explicit StressChecks(const StressLimits& limits) : limits_(limits) {}

  /// To be called step by step, from time 0 on.
  void put_in(const Energies& energies);
  /// To be called moment by moment, from time 0 on.  Returns the first bound that does not hold.
  std::optional<StressFailure> look(const StressMoment& now);
  /// The same for energy; `scheme_loss`: J, the moment's centred_loss.
  std::optional<StressFailure> look_at_energy(const StressMoment& now, double scheme_loss);

  /// How near runs have come to their bounds: value by bound, 1 at the bound.
  const std::map<std::string, double>& nearest() const { return nearest_; }

 private:
  double available() const { return (1.0 + energy_fraction) * put_in_; } ///< J
  std::optional<StressFailure> check_speed(const StressMoment& now);
  std::optional<StressFailure> check_points(const StressMoment& now);
  std::optional<StressFailure> at_most(const std::string& check, double value, double bound,
                                       const StressMoment& now, std::size_t point,
                                       const std::string& what);

  StressLimits limits_;
  double put_in_ = 0.0;              ///< J, P
  double first_kinetic_ = -1;        ///< J, T(0); negative: not yet known
  double peak_ = 0.0;                ///< J, of the nodes' kinetic energy
  std::size_t still_ = 0;            ///< looks since it was above 1e-3 of its peak
  std::deque<double> losses_;        ///< J, scheme_loss at the last looks
  std::optional<double> first_loss_; ///< J, what they count from
  std::optional<double> loss_at_rest_;
  double largest_speed_ = 0.0; ///< m/s, v_max
  std::map<std::string, double> nearest_;
};

/// Empty if the point left at a free side, not too fast.  `last`: the moment of the error.
std::optional<StressFailure> explain(const RunError& error, const Scene& scene,
                                     const StressMoment& last);

} // namespace scarp::apps
