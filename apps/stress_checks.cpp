#include "apps/stress_checks.hpp"

#include "core/drucker_prager.hpp"
#include "core/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>

namespace scarp::apps {

namespace {

/// Of the scene's gravity, over all stages and regions.
double largest_multiple(const Scene& scene) {
  double most = 0.0;
  for (const Stage& stage : stages_of(scene))
    for (const Region& region : scene.regions) most = std::max(most, stage.largest_gravity(region));
  return most;
}

/// Whether a side holds what moves along it.
bool holds_along(const Grid& grid) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == 1 && grid.dimension == 2) continue;
    for (const Wall& wall : grid.walls[i])
      if (wall.kind == WallKind::fixed || wall.kind == WallKind::friction) return true;
  }
  return false;
}

double norm(const double* v) { return std::hypot(v[0], v[1], v[2]); }

bool finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

bool finite(const StressMoment& now) {
  const Energies& e = now.energies;
  return std::isfinite(e.scheme_loss + e.grid_kinetic) && finite(now.position) &&
         finite(now.velocity) && finite(now.mean_stress) && finite(now.volume) &&
         finite(now.plastic_strain);
}

} // namespace

double StressLimits::fastest(double time) const {
  const double free =
      std::min(speed + body_force * time, std::sqrt(speed * speed + 2.0 * potential));
  return 2.0 * across * std::sqrt(density_ratio) * free;
}

double StressLimits::stress(double largest_speed) const {
  return 2.0 * waves * impedance * largest_speed + stress_concentration * weight;
}

double StressLimits::horn(double initial_volume) const {
  return std::sqrt(std::max(1.0, square / initial_volume));
}

double StressLimits::impact(double initial_volume) const {
  const double part = std::pow(std::min(1.0, initial_volume / square), 1.0 / dimension);
  return std::pow(2.0 / (1.0 + part), dimension);
}

double StressLimits::fastest_of(double initial_volume, double time, double energy) const {
  const double whole = fastest(time);
  const double alone = std::sqrt(2.0 * energy / (lightest * initial_volume));
  return std::max(whole, std::min(impact(initial_volume) * whole, alone));
}

double StressLimits::stress_of(double initial_volume, double largest_speed, double energy) const {
  const double whole = stress(largest_speed);
  const double alone = std::sqrt(2.0 * stiffest * energy / initial_volume);
  return std::max(whole, std::min(horn(initial_volume) * whole, alone));
}

StressLimits stress_limits(const Scene& scene) {
  StressLimits limits;
  const Grid& grid = scene.grid;
  limits.dimension = grid.dimension;
  const double multiple = largest_multiple(scene);
  limits.body_force = multiple * norm(scene.gravity.data());
  limits.room = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == 1 && grid.dimension == 2) continue;
    const double extent = grid.upper[i] - grid.lower[i];
    limits.potential += multiple * std::abs(scene.gravity[i]) * extent;
    limits.room *= extent;
  }
  limits.square = std::pow(grid.cell_size / grid.points_per_cell, grid.dimension);
  double heaviest = 0.0;
  limits.lightest = limits.bulk = std::numeric_limits<double>::infinity();
  for (const Material& material : scene.materials) {
    const auto moduli = ElasticModuli::from(material.youngs_modulus, material.poissons_ratio);
    heaviest = std::max(heaviest, material.density);
    limits.lightest = std::min(limits.lightest, material.density);
    limits.impedance = std::max(limits.impedance, std::sqrt(moduli.p_wave() * material.density));
    limits.bulk = std::min(limits.bulk, moduli.bulk);
    limits.stiffest = std::max(limits.stiffest, moduli.bulk);
    if (const auto* law = std::get_if<DruckerPrager>(&material.law))
      limits.dilation = std::max(limits.dilation,
                                 std::sqrt(3.0) * cone_of(law->cone, law->dilation_angle, 0.0)[0]);
    limits.waves = std::max(limits.waves, grid.dimension * moduli.bulk / moduli.p_wave());
    const double r = holds_along(grid) ? 1.0 : 1.0 - 2.0 * moduli.shear / moduli.p_wave();
    const double along = 1.0 + (grid.dimension - 1) * r * r;
    limits.across =
        std::max(limits.across, std::sqrt(along * along + (grid.dimension - 1) * r * r));
  }
  limits.density_ratio = heaviest / limits.lightest;

  const double far = std::numeric_limits<double>::infinity();
  std::array<double, 3> lower = {far, far, far};
  std::array<double, 3> upper = {-far, -far, -far};
  const auto reach = [&](std::size_t axis, double x) {
    lower[axis] = std::min(lower[axis], x);
    upper[axis] = std::max(upper[axis], x);
  };
  for (const Region& region : scene.regions) {
    limits.speed = std::max(limits.speed, norm(region.velocity.data()));
    for (const auto& corner : region.polygon) {
      reach(0, corner[0]);
      reach(2, corner[1]);
    }
    for (const double y : region.depth) reach(1, grid.dimension == 3 ? y : 0.0);
  }
  for (std::size_t i = 0; i < 3; ++i)
    limits.weight += heaviest * limits.body_force * (upper[i] - lower[i]);

  const double end = end_time(scene);
  double wave = 0.0;
  for (const Stage& stage : stages_of(scene)) wave = std::max(wave, critical_speed(scene, stage));
  const double shortest =
      std::min(scene.timing.max_time_step,
               scene.timing.cfl * critical_step(grid.cell_size, wave, limits.fastest(end),
                                                limits.body_force, 2.0));
  // Frames, gates and stages cut a step in two.
  limits.steps = 1.01 * end / shortest + 100.0;
  return limits;
}

StressMoment stress_moment(const Simulation& simulation) {
  const std::vector<double> volume = simulation.field("volume");
  std::vector<double> mass = simulation.field("density");
  for (std::size_t p = 0; p < mass.size(); ++p) mass[p] *= volume[p];
  return {.time = simulation.time(),
          .steps = simulation.steps(),
          .energies = simulation.energies(),
          .position = simulation.positions(),
          .velocity = simulation.field("velocity"),
          .gradient = simulation.field("velocity_gradient"),
          .mass = mass,
          .mean_stress = simulation.field("mean_stress"),
          .volume = volume,
          .initial_volume = simulation.field("initial_volume"),
          .plastic_strain = simulation.field("equivalent_plastic_strain")};
}

double centred_loss(const StressMoment& now, const std::vector<double>& next_velocity,
                    const std::vector<double>& next_gradient, double h) {
  double centred = 0.0;
  for (std::size_t p = 0; p < now.mass.size(); ++p) {
    const auto product = [p](const std::vector<double>& a, const std::vector<double>& b,
                             std::size_t components) {
      const auto first = static_cast<std::ptrdiff_t>(components * p);
      return std::inner_product(a.begin() + first,
                                a.begin() + first + static_cast<std::ptrdiff_t>(components),
                                b.begin() + first, 0.0);
    };
    centred += 0.5 * now.mass[p] *
               (product(now.velocity, next_velocity, 3) +
                0.25 * h * h * product(now.gradient, next_gradient, 9));
  }
  return now.energies.scheme_loss + now.energies.kinetic - centred;
}

std::optional<StressFailure> StressChecks::at_most(const std::string& check, double value,
                                                   double bound, const StressMoment& now,
                                                   std::size_t point, const std::string& what) {
  if (value <= bound) {
    double& nearest = nearest_[check];
    if (value > 0.0) nearest = std::max(nearest, value / bound);
    return std::nullopt;
  }
  return StressFailure{check, value, bound, now.time, point, what};
}

void StressChecks::put_in(const Energies& energies) {
  if (first_kinetic_ < 0.0) first_kinetic_ = energies.kinetic;
  put_in_ = std::max(put_in_, first_kinetic_ + energies.gravity_work);
}

std::optional<StressFailure> StressChecks::check_speed(const StressMoment& now) {
  for (std::size_t p = 0; p < now.volume.size(); ++p) {
    const double speed = norm(&now.velocity[3 * p]), V0 = now.initial_volume[p];
    if (auto failure = at_most("speed", speed, limits_.fastest_of(V0, now.time, available()), now,
                               p, "m/s, of a point"))
      return failure;
    largest_speed_ = std::max(largest_speed_, speed / limits_.impact(V0));
  }
  return std::nullopt;
}

std::optional<StressFailure> StressChecks::check_points(const StressMoment& now) {
  for (std::size_t p = 0; p < now.volume.size(); ++p) {
    const double V0 = now.initial_volume[p], J = now.volume[p] / V0;
    const double stress = limits_.stress_of(V0, largest_speed_, available());
    if (auto failure = at_most("stress", J * std::abs(now.mean_stress[p]), stress, now, p,
                               "Pa, size of a point's mean Kirchhoff stress"))
      return failure;
    const double undilated = now.volume[p] * std::exp(-limits_.dilation * now.plastic_strain[p]);
    if (auto failure = at_most("volume", undilated, limits_.room, now, p,
                               "m3, or m2 in plane strain, of a point but for its dilation"))
      return failure;
    if (auto failure = at_most("volume", 0.5 * std::exp(-stress / limits_.bulk), J, now, p,
                               "-, the smallest V/V0 explained; the bound is a point's"))
      return failure;
  }
  return std::nullopt;
}

std::optional<StressFailure> StressChecks::look_at_energy(const StressMoment& now,
                                                          double scheme_loss) {
  const Energies& energies = now.energies;
  // Of sums of that size, where P is 0 at first.
  const double rounding = 1e-12 * (energies.kinetic + energies.strain);
  for (const double loss : {energies.damping, energies.wall_friction, energies.plastic})
    if (auto failure = at_most("losses", -loss, energy_fraction * put_in_ + rounding, now, 0,
                               "J, given by damping, friction or plastic flow"))
      return failure;
  peak_ = std::max(peak_, energies.grid_kinetic);
  if (!first_loss_) first_loss_ = std::min(scheme_loss, 0.0);
  losses_.push_back(scheme_loss - *first_loss_);
  if (losses_.size() > energy_window) losses_.pop_front();
  if (losses_.size() < energy_window) return std::nullopt;
  const double loss =
      std::reduce(losses_.begin(), losses_.end()) / static_cast<double>(energy_window);
  if (auto failure = at_most("energy", -loss, energy_fraction * put_in_ + rounding, now, 0,
                             "J, made by the scheme"))
    return failure;

  still_ = energies.grid_kinetic > 1e-3 * peak_ ? 0 : still_ + 1;
  if (!loss_at_rest_ && still_ >= energy_window) loss_at_rest_ = loss;
  if (!loss_at_rest_) return std::nullopt;
  return at_most("rest", *loss_at_rest_ - loss, rest_fraction * put_in_ + rounding, now, 0,
                 "J, made by the scheme after rest");
}

std::optional<StressFailure> StressChecks::look(const StressMoment& now) {
  if (!finite(now)) return StressFailure{"numbers", NAN, 0.0, now.time, 0, "not finite"};
  if (auto failure =
          at_most("steps", static_cast<double>(now.steps), limits_.steps, now, 0, "steps"))
    return failure;
  put_in(now.energies);
  if (auto failure = check_speed(now)) return failure;
  return check_points(now);
}

std::optional<StressFailure> explain(const RunError& error, const Scene& scene,
                                     const StressMoment& last) {
  const std::size_t p = error.point();
  const double speed = norm(&last.velocity[3 * p]);
  const double bound = stress_limits(scene).fastest_of(last.initial_volume[p], last.time,
                                                       std::numeric_limits<double>::infinity());
  const Grid& grid = scene.grid;
  bool at_free_side = false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == 1 && grid.dimension == 2) continue;
    // A step takes a point through less than a cell.
    const double x = error.position()[i];
    at_free_side |= grid.walls[i][0].kind == WallKind::free && x < grid.lower[i] + grid.cell_size;
    at_free_side |= grid.walls[i][1].kind == WallKind::free && x > grid.upper[i] - grid.cell_size;
  }
  if (at_free_side && speed <= bound) return std::nullopt;
  return StressFailure{"leaving", speed, at_free_side ? bound : 0.0,
                       last.time, p,     fmt::format("m/s, of a point; {}", error.what())};
}

} // namespace scarp::apps
