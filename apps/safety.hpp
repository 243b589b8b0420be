// Factor of safety by strength reduction: the factor F at which a body at rest fails once its
// strength is c/F and tan(phi)/F (Zienkiewicz, Humpheson & Lewis 1975, Geotechnique 25(4):671-689;
// Griffiths & Lane 1999, Geotechnique 49(3):387-403, doi 10.1680/geot.1999.49.3.387).
//
// Equilibrium.  The stages before a scene's last one; a scene without such gets one, with elastic
// materials and rising gravity.  All trials start from the same state at their end, with the
// scene's last stage and the reduced strength.
//
// Failure.  With the body's height H (in z), its first period in shear T = 4 H / c_s (c_s the
// slowest shear wave), its largest displacement u_0 on the way to the equilibrium, and the largest
// displacement u since then, a trial has
//   failed         once u exceeds u_f = part_of_height H + u_0;
//   come to rest   once no point has moved by more than u_f W/N within the last W = 10 periods.
// A body that does not come to rest covers u_f within N periods, so one of the two happens by then.
// Should it swing about for longer, it has not come to rest and counts as failed.
//
// Motion is quasi-static: local damping (Cundall) takes a part of the force that is out of balance,
// nothing at rest, and so does not support the body.
#pragma once

#include "core/simulation.hpp"
#include "io/frame.hpp"

#include <functional>
#include <vector>

namespace scarp::apps {

struct FailureRule {
  /// -; many times what a body that stands yields, and little enough that points stay in their
  /// cells: with linear shape functions a slide is held up where they cross into the next.
  double part_of_height = 0.005;
  double periods = 200.0; ///< -, N above
};

enum class Verdict { stable, failed, still_moving };

struct Trial {
  double factor = 0.0; ///< -
  Verdict verdict = Verdict::stable;
  double displacement = 0.0; ///< m, the largest since the equilibrium
  /// m, of the scene's monitors in their order.
  std::vector<double> monitor_displacement;
  double kinetic_energy = 0.0; ///< J, in plane strain J/m, at the end
  double time = 0.0;           ///< s, simulated since the equilibrium
  long steps = 0;
  double wall = 0.0; ///< s
  io::Frame frame;   ///< the last state, with its plastic strain

  bool fails() const { return verdict != Verdict::stable; }
};

/// The material with c/F and atan(tan(phi)/F).  The dilation angle stays as it is until the
/// friction angle has come down to it and then follows it: a larger one would make energy.
Material reduced(const Material& material, double factor);

/// A scene and the state of equilibrium that all trials start from.
class StrengthReduction {
 public:
  /// Told now and then: periods since the start, and the largest displacement since then, m.
  using Watch = std::function<void(double periods, double displacement)>;

  /// Without local damping in the scene there is that of `usual_damping`.  Throws SetupError if
  /// there is nothing to reduce: no region has a Drucker-Prager material in the last stage.
  explicit StrengthReduction(Scene scene, FailureRule rule = {});

  /// Runs up to the equilibrium.  Throws RunError, and SetupError if a gate is still to open then.
  void settle();
  /// What becomes of the body with a factor above 0; after settle().  Throws RunError.
  Trial try_factor(double factor, const Watch& watch) const;

  double height() const { return height_; }         ///< m
  double period() const { return period_; }         ///< s
  double settlement() const { return settlement_; } ///< m, u_0 above
  double failure_displacement() const;              ///< m, u_f above
  double local_damping() const { return scene_.method.local_damping; }
  std::size_t points() const { return start_.position.size() / 3; }
  bool own_equilibrium() const { return own_equilibrium_; }

  static constexpr double usual_damping = 0.75;
  static constexpr int rest_window = 10; ///< periods, W above

 private:
  Scene scene_; ///< with stages
  FailureRule rule_;
  bool own_equilibrium_; ///< the scene has no stage for it
  double height_;
  double period_;
  double settlement_ = 0.0;
  Snapshot start_;
};

} // namespace scarp::apps
