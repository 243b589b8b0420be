// Body forces: gravity, its ramps and the regions' multiples of it, and the work they do.
#pragma once

#include "core/particles.hpp"
#include "core/scene.hpp"

#include <vector>

namespace scarp {

/// b_r(t) = gravity * stage.gravity(t) * stage.body_force[r](t), t since the stage began.
template <int Dim> class Loads {
 public:
  explicit Loads(const Scene& scene);

  /// Throws SetupError if the stage loads a region that the scene does not have.
  void begin_stage(const Stage& stage, double start_time);
  /// The forces at a time of the present stage.
  void update(double time);

  /// m/s2, of all points where the regions agree, else 0.
  const Vec<Dim>& common() const { return common_; }
  /// m/s2, by region; empty where the regions agree.
  const std::vector<Vec<Dim>>& own() const { return own_; }

  /// m/s2, of one region's points
  Vec<Dim> force(std::size_t region) const;

  /// m/s2, the size of the largest of them.
  Real largest() const;

  /// J, - sum m b . x with the present forces.
  template <class T> Real potential(const Particles<Dim, T>& points) const;
  /// J, done by the forces since the first call of settle().
  template <class T> Real work(const Particles<Dim, T>& points) const;
  /// Books the work up to now.  Necessary before forces change; until then the work is that of
  /// constant forces, and follows from the positions alone.
  template <class T> void settle(const Particles<Dim, T>& points);
  /// Whether the forces change within the present stage, so that every step has to be settled.
  bool vary() const { return vary_; }

 private:
  /// sum m x by region
  template <class T> std::vector<Vec<Dim>> moments(const Particles<Dim, T>& points) const;
  Real work_at(const std::vector<Vec<Dim>>& moments) const;

  Vec<Dim> gravity_;
  std::vector<std::string> regions_;
  Ramp all_;
  std::vector<Ramp> by_region_;
  double start_ = 0.0; ///< s, of the stage
  bool vary_ = false;
  Vec<Dim> common_ = {};
  std::vector<Vec<Dim>> own_;
  std::vector<Vec<Dim>> settled_; ///< moments at the last settle()
  Real work_ = 0.0;
};

} // namespace scarp
