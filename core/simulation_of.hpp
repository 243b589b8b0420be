// The solver behind core/simulation.hpp, for a dimension and shape functions.  Instantiated in
// core/simulation_*.cpp, one file a shape function.
#pragma once

#include "core/simulation.hpp"

#include "core/affine.hpp"
#include "core/body_force_pass.hpp"
#include "core/contact_pass.hpp"
#include "core/fields.hpp"
#include "core/first_places.hpp"
#include "core/gather_pass.hpp"
#include "core/lattice.hpp"
#include "core/loads.hpp"
#include "core/material_model.hpp"
#include "core/move_pass.hpp"
#include "core/node_pass.hpp"
#include "core/scatter_pass.hpp"
#include "core/static_equilibrium.hpp"
#include "core/stress_pass.hpp"
#include "core/time_step.hpp"
#include "core/walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <variant>

namespace scarp {

inline bool remembers_gaps(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    const auto* law = std::get_if<DruckerPrager>(&material.law);
    return law && law->opening == Opening::remembered;
  });
}

/// Where the core's stress components stand among xx yy zz xy yz xz of the scene's axes.
template <int Dim>
constexpr std::array<std::size_t, tensor_size<Dim>> stress_place = [] {
  if constexpr (Dim == 2)
    return std::array<std::size_t, 4>{0, 2, 1, 5};
  else
    return std::array<std::size_t, 6>{0, 1, 2, 3, 4, 5};
}();

/// Where d v_i / d x_j of the core's axes stands among the nine of the scene's.
template <int Dim> constexpr std::size_t gradient_place(std::size_t i, std::size_t j) {
  return 3 * scene_axis<Dim>(static_cast<int>(i)) + scene_axis<Dim>(static_cast<int>(j));
}

template <int Dim, class Shape> class SimulationOf final : public Simulation {
  using Number = typename Shape::Number;

 public:
  SimulationOf(const Scene& scene, const Snapshot* start)
      : scene_(scene), stages_(stages_of(scene)),
        state_(scene.grid, Particles<Dim, Number>(fill_regions<Dim>(scene)), remembers_gaps(scene)),
        first_places_(scene.grid, state_.particles.x), walls_(scene, state_.grid), loads_(scene) {
    for (const Material& material : scene.materials) materials_.emplace_back(material);
    state_.averages_volume = scene.method.volume_rate == VolumeRate::cell_average;
    if (scene.method.transfer != VelocityTransfer::flip) {
      for (auto& column : state_.particles.C) column.assign(points(), Number(0));
      state_.moves_with_strain = scene.method.scheme == Scheme::musl;
    }
    const auto continued =
        std::ranges::find_if(stages_, [](const Stage& stage) { return !stage.begin_from.empty(); });
    if ((continued != stages_.end()) != (start != nullptr))
      throw SetupError(start ? "no stage begins from another run's state"
                             : "stage '" + continued->name + "' begins from '" +
                                   continued->begin_from + "', and there is no such state");
    if (scene.method.initial_stress != InitialStress::none && continued == stages_.begin())
      throw SetupError("the first stage begins from another run's state, and with its stress: "
                       "method.initial_stress must be 'none'");
    if (start) take_over(*start);
    begin_stage(start ? static_cast<std::size_t>(continued - stages_.begin()) : 0);
    state_.order.update(state_.particles);
    // A static solve has it so, and another run's state does not tell.
    if (start || scene.method.initial_stress == InitialStress::equilibrium)
      touch_all(state_);
    else
      begin_contacts(state_);
    if (!start && scene.method.initial_stress == InitialStress::equilibrium)
      equilibrium_ =
          StaticEquilibrium<Dim, Shape>(state_, walls_, materials_).find([this](std::size_t p) {
            return body_force(p);
          });
    loads_.settle(state_.particles);
    first_energies_ = energies();
  }

  double step(double until) override {
    const NextStep next = next_step(until);
    const double dt = next.dt;
    const Scheme scheme = scene_.method.scheme;
    walls_.open_gates(time_);
    if (loads_.vary()) loads_.update(time_);
    state_.order.update(state_.particles, state_.left);
    find_contacts_pass(state_, loads_.largest(), dt);
    done(Phase::sort);

    if (scheme == Scheme::usf) {
      scatter_pass<Dim, Terms::mass_momentum>(state_);
      done(Phase::scatter);
      gather_momentum_pass(state_, walls_);
      done(Phase::nodes);
      for_each_tile(state_, [&](std::size_t tile) { update_stress(tile, dt); });
      done(Phase::stress);
      scatter_pass<Dim, Terms::force>(state_, loads_.own());
      done(Phase::scatter);
    } else {
      scatter_pass<Dim, Terms::all>(state_, loads_.own());
      done(Phase::scatter);
      gather_momentum_pass(state_, walls_);
    }
    if (scene_.body_force) body_force_pass(state_, scene_.body_force, time_);
    advance_momentum_pass(state_, walls_, loads_.common(), damping(), dt);
    done(Phase::nodes);

    if (scheme == Scheme::musl) {
      remember_speed(gather_pass<Dim, true>(state_, flip()));
      done(Phase::gather);
      remap_velocity_pass(state_, walls_, dt);
      done(Phase::remap);
    } else {
      remember_speed(gather_pass<Dim, false>(state_, flip()));
      done(Phase::gather);
    }
    const LostPoints lost =
        scheme == Scheme::usf
            ? move_pass(state_, dt, [](std::size_t) {})
            : move_pass(state_, dt, [&](std::size_t tile) { update_stress(tile, dt); });
    add_up_losses();
    if (loads_.vary()) loads_.settle(state_.particles);
    time_ = next.time;
    ++steps_;
    check(lost);
    done(Phase::stress);
    return dt;
  }

  int dimension() const override { return Dim; }
  double time() const override { return time_; }
  long steps() const override { return steps_; }
  std::size_t points() const override { return first_places_.points(); }
  std::size_t cells() const override { return static_cast<std::size_t>(state_.grid.cell_count); }
  std::size_t occupied_cells() const override { return state_.order.cells().size(); }
  std::size_t memory() const override {
    return state_.memory() + first_places_.memory() + walls_.memory();
  }

  bool waits_for_gate() const override { return std::isfinite(walls_.next_opening(time_)); }

  const Stage& stage() const override { return stages_[stage_]; }
  double stage_end() const override { return stage_start_ + stages_[stage_].duration; }
  bool in_last_stage() const override { return stage_ + 1 == stages_.size(); }

  void next_stage() override {
    if (in_last_stage()) throw std::logic_error("next_stage: there is none");
    loads_.settle(state_.particles);
    begin_stage(stage_ + 1);
  }

  double stable_time_step() const override {
    return std::min(scene_.timing.max_time_step, scene_.timing.cfl * critical_time_step());
  }

  Energies energies() const override;

  double front() const override {
    const std::vector<std::string>& names = scene_.output.front_regions;
    std::vector<std::uint8_t> counts;
    for (const Region& region : scene_.regions)
      counts.push_back(names.empty() || std::ranges::find(names, region.name) != names.end());
    Real front = -std::numeric_limits<Real>::infinity();
    state_.particles.for_each([&](std::size_t p) {
      if (counts[state_.particles.region[p]]) front = std::max(front, state_.particles.x[0][p]);
    });
    return front;
  }

  std::vector<PlanLine> plan() const override;
  std::vector<double> positions() const override;
  std::vector<double> field(const std::string& name) const override;

  std::size_t nearest_point(const std::array<double, 3>& place) const override {
    std::size_t nearest = 0;
    Real least = std::numeric_limits<Real>::infinity();
    for (std::size_t p = 0; p < points(); ++p) {
      Real distance2 = 0.0;
      const Vec<Dim> first = first_places_.of(p);
      for (int a = 0; a < Dim; ++a) {
        const std::size_t i = scene_axis<Dim>(a);
        const Real d = first[static_cast<std::size_t>(a)] - place[i];
        distance2 += d * d;
      }
      if (distance2 < least) {
        least = distance2;
        nearest = p;
      }
    }
    return nearest;
  }

 private:
  struct NextStep {
    double dt;   ///< s
    double time; ///< s, at its end
  };

  void begin_stage(std::size_t stage) {
    stage_ = stage;
    stage_start_ = time_;
    loads_.begin_stage(stages_[stage], time_);
    material_of_region_.clear();
    for (const Region& region : scene_.regions)
      material_of_region_.push_back(static_cast<std::uint8_t>(
          material_index(scene_, region, stages_[stage].material_of(region))));
    wave_ = critical_speed(scene_, stages_[stage]);
    auto& points = state_.particles;
    points.for_each(
        [&](std::size_t p) { points.material[p] = material_of_region_[points.region[p]]; });
    fastest_ = 0.0; // as in a run that begins here
    points.for_each([this](std::size_t p) { fastest_ = std::max(fastest_, speed_beside(p)); });
  }

  /// m/s2, at row p and the present time.
  Vec<Dim> body_force(std::size_t p) const {
    Vec<Dim> b = loads_.force(state_.particles.region[p]);
    if (!scene_.body_force) return b;
    const std::array<double, 3> more = scene_.body_force(place(p), time_);
    for (int a = 0; a < Dim; ++a) b[static_cast<std::size_t>(a)] += more[scene_axis<Dim>(a)];
    return b;
  }

  /// m, x y z of row p; y = 0 in plane strain.
  std::array<double, 3> place(std::size_t p) const {
    std::array<double, 3> x = {0.0, 0.0, 0.0};
    for (int a = 0; a < Dim; ++a)
      x[scene_axis<Dim>(a)] = state_.particles.x[static_cast<std::size_t>(a)][p];
    return x;
  }

  void take_over(const Snapshot& start);
  std::string stages_line() const;
  std::string initial_stress_line() const;

  /// dt = min(CFL, the user's maximum), afresh each step.  `until` and the opening of gates are met
  /// to the bit; the last two steps before them share what is left.
  NextStep next_step(double until) const {
    const double own_end = in_last_stage() ? until : std::min(until, stage_end());
    const double target = std::min(own_end, walls_.next_opening(time_));
    const double left = target - time_;
    if (!(left > 0.0)) throw std::invalid_argument("step: until must lie ahead of the time");
    const double dt = stable_time_step();
    if (left > 2.0 * dt) return {dt, time_ + dt};
    if (left > dt) return {0.5 * left, time_ + 0.5 * left};
    return {left, target};
  }

  /// Of a tile's points, material by material.
  void update_stress(std::size_t tile, Real dt) {
    for (std::size_t k = 0; k < materials_.size(); ++k)
      std::visit(
          [&](const auto& law) {
            stress_of_tile<Dim>(state_, tile, static_cast<std::uint8_t>(k), materials_[k].moduli,
                                law, materials_[k].opens, dt);
          },
          materials_[k].update);
  }

  /// s
  double critical_time_step() const {
    return critical_step(state_.grid.h, wave_, fastest_, loads_.largest(), Shape::steepest);
  }

  /// Part of FLIP in the velocity update of this step.
  Real flip() const {
    const Method& method = scene_.method;
    const Real cfl =
        std::min(scene_.timing.cfl, scene_.timing.max_time_step / critical_time_step());
    switch (method.transfer) {
    case VelocityTransfer::apic:
      return 0.0;
    case VelocityTransfer::aflip:
      return flip_of_step(method.affine_flip, cfl);
    case VelocityTransfer::flip:
      break;
    }
    return flip_of_step(method.flip, cfl);
  }

  /// m/s, of the fastest point now.  It is forgotten slowly: where the step follows what swings, it
  /// is shorter at every swing's fastest, and such a step pumps energy into the swing.
  void remember_speed(Real now) {
    constexpr Real kept = 0.99; // a step
    fastest_ = std::max(now, kept * fastest_);
  }

  Real damping() const {
    const Method& method = scene_.method;
    return waits_for_gate() ? std::max(method.settling_damping, method.local_damping)
                            : method.local_damping;
  }

  void add_up_losses() {
    if (damping() > 0.0)
      for (const Real work : state_.nodal.damped) damping_work_ += work;
    friction_work_ += state_.nodal.rubbed;
  }

  Real gap(std::size_t p) const {
    return state_.particles.gap.empty() ? 0.0 : state_.particles.gap[p];
  }

  Real speed(std::size_t p) const {
    Real v2 = 0.0;
    for (const auto& v : state_.particles.v) v2 += v[p] * v[p];
    return std::sqrt(v2);
  }

  /// m/s, at row p, with gradients at a control point's distance, as gather_pass has it.
  Real speed_beside(std::size_t p) const {
    if (!state_.particles.affine()) return speed(p);
    Real C2 = 0.0;
    for (const auto& C : state_.particles.C) C2 += C[p] * C[p];
    return speed(p) + 0.5 * state_.grid.h * std::sqrt(C2);
  }

  void check(const LostPoints& lost) const {
    if (lost.outside != no_point)
      fail(lost.outside, "leaves the grid or is no number any more",
           "enlarge the grid, or lower time.cfl");
    if (lost.turned_over != no_point)
      fail(lost.turned_over, "has a negative volume",
           "lower time.cfl, or look for a point thrown against a wall");
  }

  [[noreturn]] void fail(std::uint32_t bad, const std::string& complaint,
                         const std::string& advice) const {
    const auto& id = state_.particles.id;
    const auto p = static_cast<std::size_t>(std::find(id.begin(), id.end(), bad) - id.begin());
    const std::array<double, 3> x = place(p);
    std::ostringstream text;
    text << "step " << steps_ << ", time " << time_ << " s: point " << bad << " at x = " << x[0];
    if constexpr (Dim == 3) text << ", y = " << x[1];
    text << ", z = " << x[2] << " m (speed " << speed(p) << " m/s) " << complaint
         << "; try: " << advice;
    throw RunError(text.str(), steps_, time_, bad, x);
  }

  Scene scene_;
  std::vector<Stage> stages_;
  State<Dim, Shape> state_;
  FirstPlaces<Dim> first_places_;
  Walls<Dim> walls_;
  Loads<Dim> loads_;
  std::vector<MaterialModel> materials_;
  std::vector<std::uint8_t> material_of_region_; ///< in the present stage
  Real wave_ = 0.0;                              ///< m/s, critical_speed of the present stage
  std::size_t stage_ = 0;
  double stage_start_ = 0.0;               ///< s
  std::optional<Equilibrium> equilibrium_; ///< that the run began with
  Energies first_energies_;
  Real fastest_ = 0.0;         ///< m/s, largest speed of a point, forgotten slowly
  double damping_work_ = 0.0;  ///< J
  double friction_work_ = 0.0; ///< J
  double time_ = 0.0;
  long steps_ = 0;
};

template <int Dim, class Shape> void SimulationOf<Dim, Shape>::take_over(const Snapshot& start) {
  auto& points = state_.particles;
  const std::size_t n = points.rows(); // before the first order: in that of creation
  if (start.position.size() != 3 * n)
    throw SetupError("the state to begin from has " + std::to_string(start.position.size() / 3) +
                     " points, the scene has " + std::to_string(n));
  if (points.affine() && start.velocity_gradient.size() != 9 * n)
    throw SetupError("the state to begin from has no velocity gradients, which an affine transfer "
                     "needs");
  const double tolerance = 1e-6 * state_.grid.h;
  for (std::size_t p = 0; p < n; ++p) {
    bool same = std::abs(start.initial_volume[p] - points.V0[p]) <= 1e-6 * points.V0[p];
    const Vec<Dim> first = first_places_.of(p);
    for (int a = 0; a < Dim; ++a) {
      const std::size_t i = 3 * p + scene_axis<Dim>(a);
      same = same && std::abs(start.position[i] - start.displacement[i] -
                              first[static_cast<std::size_t>(a)]) <= tolerance;
    }
    if (!same)
      throw SetupError("point " + std::to_string(p) +
                       " of the state to begin from is another than the scene's");
  }
  time_ = start.time;
  steps_ = start.steps;
  for (std::size_t p = 0; p < n; ++p) {
    for (int a = 0; a < Dim; ++a) {
      const auto i = static_cast<std::size_t>(a);
      points.x[i][p] = start.position[3 * p + scene_axis<Dim>(a)];
      points.v[i][p] = static_cast<Number>(start.velocity[3 * p + scene_axis<Dim>(a)]);
    }
    points.J[p] = static_cast<Number>(start.volume[p] / points.V0[p]);
    for (std::size_t i = 0; i < points.tau.size(); ++i)
      points.tau[i][p] =
          static_cast<Number>(points.J[p] * start.stress[6 * p + stress_place<Dim>[i]]);
    if (points.affine())
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j)
          points.C[Dim * i + j][p] =
              static_cast<Number>(start.velocity_gradient[9 * p + gradient_place<Dim>(i, j)]);
    points.plastic_strain[p] = static_cast<Number>(start.plastic_strain[p]);
    if (!points.gap.empty()) points.gap[p] = static_cast<Number>(start.gap[p]);
  }
}

template <template <int, class> class Shape, class Number = Real>
std::unique_ptr<Simulation> make_simulation_with(const Scene& scene, const Snapshot* start) {
  if (scene.grid.dimension == 2)
    return std::make_unique<SimulationOf<2, Shape<2, Number>>>(scene, start);
  return std::make_unique<SimulationOf<3, Shape<3, Number>>>(scene, start);
}

} // namespace scarp

#include "core/simulation_output.hpp"
