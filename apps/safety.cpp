#include "apps/safety.hpp"

#include "core/run.hpp"
#include "io/run_recorder.hpp"
#include "io/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <set>

namespace scarp::apps {

namespace {

/// What the body is made of during a stage.
std::vector<Material> materials_in(const Scene& scene, const Stage& stage) {
  std::set<std::string> names;
  for (const Region& region : scene.regions) names.insert(stage.material_of(region));
  std::vector<Material> used;
  for (const Material& material : scene.materials)
    if (names.contains(material.name)) used.push_back(material);
  return used;
}

/// m, from the lowest to the highest place of the regions.
double height_of(const Scene& scene) {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -lower;
  for (const Region& region : scene.regions)
    for (const auto& corner : region.polygon) {
      lower = std::min(lower, corner[1]);
      upper = std::max(upper, corner[1]);
    }
  return upper - lower;
}

/// m/s, of the slowest shear wave.
double shear_wave(const std::vector<Material>& materials) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const Material& material : materials) {
    const double shear = material.youngs_modulus / (2.0 * (1.0 + material.poissons_ratio));
    slowest = std::min(slowest, std::sqrt(shear / material.density));
  }
  return slowest;
}

/// Puts a stage before the scene's only one: gravity rises over ten periods while all is elastic
/// and acts for ten more, in which what still swings is damped away.
void give_equilibrium(Scene& scene, double period) {
  Stage rise;
  rise.name = "equilibrium";
  rise.duration = 20.0 * period;
  rise.gravity.points = {{0.0, 0.0}, {10.0 * period, 1.0}};
  for (const Region& region : scene.regions) {
    const std::string name = region.material + " (elastic)";
    rise.material[region.name] = name;
    if (std::ranges::find(scene.materials, name, &Material::name) != scene.materials.end())
      continue;
    Material elastic = *std::ranges::find(scene.materials, region.material, &Material::name);
    elastic.name = name;
    elastic.law = LinearElastic{};
    scene.materials.push_back(elastic);
  }
  if (scene.stages.empty()) scene.stages.emplace_back().name = "reduced strength";
  scene.stages.insert(scene.stages.begin(), rise);
}

/// s since the stage began, from when on its loads are constant.
double loads_constant_from(const Stage& stage) {
  double time = stage.gravity.points.back()[0];
  for (const auto& entry : stage.body_force) time = std::max(time, entry.second.points.back()[0]);
  return std::max(time, 0.0);
}

/// m, between two places of one point.
double distance(const std::vector<double>& from, const std::vector<double>& to, std::size_t point) {
  double square = 0.0;
  for (std::size_t i = 3 * point; i < 3 * point + 3; ++i)
    square += (to[i] - from[i]) * (to[i] - from[i]);
  return std::sqrt(square);
}

double largest_distance(const std::vector<double>& from, const std::vector<double>& to) {
  double largest = 0.0;
  for (std::size_t p = 0; p < from.size() / 3; ++p)
    largest = std::max(largest, distance(from, to, p));
  return largest;
}

} // namespace

Material reduced(const Material& material, double factor) {
  Material weaker = material;
  if (auto* law = std::get_if<DruckerPrager>(&weaker.law)) {
    constexpr double degree = std::numbers::pi / 180.0;
    const auto divide = [factor](DruckerPrager& strength) {
      strength.cohesion /= factor;
      strength.friction_angle =
          std::atan(std::tan(strength.friction_angle * degree) / factor) / degree;
      strength.dilation_angle = std::min(strength.dilation_angle, strength.friction_angle);
    };
    DruckerPrager last = law->at_residual();
    divide(*law);
    divide(last);
    law->residual.cohesion = last.cohesion;
    law->residual.friction_angle = last.friction_angle;
    law->residual.dilation_angle = last.dilation_angle;
  }
  return weaker;
}

StrengthReduction::StrengthReduction(Scene scene, FailureRule rule)
    : scene_(std::move(scene)), rule_(rule), own_equilibrium_(scene_.stages.size() < 2),
      height_(height_of(scene_)) {
  const std::vector<Material> materials = materials_in(scene_, stages_of(scene_).back());
  if (std::ranges::none_of(materials, [](const Material& material) {
        return std::holds_alternative<DruckerPrager>(material.law);
      }))
    throw SetupError("safety: no region has a Drucker-Prager material in the last stage: there is "
                     "no strength to reduce");
  period_ = 4.0 * height_ / shear_wave(materials);
  if (own_equilibrium_) give_equilibrium(scene_, period_);
  if (scene_.method.local_damping == 0.0) scene_.method.local_damping = usual_damping;
}

void StrengthReduction::settle() {
  Scene beginning = scene_;
  beginning.stages.pop_back();
  beginning.output.fields.clear(); // all: a state to go on from
  beginning.timing.output_interval = end_time(beginning);
  const auto simulation = io::make_simulation_from_files(beginning);
  Observer nobody;
  run(*simulation, beginning.timing, nobody);
  if (simulation->waits_for_gate())
    throw SetupError("safety: a gate opens after the equilibrium; it must have opened before the "
                     "last stage, in a scene with stages");
  start_ = io::snapshot_of(io::frame_of(*simulation, beginning));
  settlement_ =
      largest_distance(std::vector<double>(start_.displacement.size(), 0.0), start_.displacement);
}

double StrengthReduction::failure_displacement() const {
  return rule_.part_of_height * height_ + settlement_;
}

Trial StrengthReduction::try_factor(double factor, const Watch& watch) const {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Scene scene = scene_;
  for (Material& material : scene.materials) material = reduced(material, factor);
  for (Stage& stage : scene.stages) stage.begin_from.clear();
  scene.stages.back().begin_from = "the equilibrium";
  scene.output.fields.clear(); // all: what the picture needs
  const auto simulation = make_simulation(scene, &start_);

  const double limit = failure_displacement();
  const double rest_limit = limit * rest_window / rule_.periods;
  const double loading = std::ceil(loads_constant_from(scene.stages.back()) / period_);
  const std::vector<double> start = simulation->positions();
  std::deque<std::vector<double>> recent = {start}; // a period apart
  Trial trial;
  trial.factor = factor;
  trial.verdict = Verdict::still_moving;
  for (double periods = 1.0; periods <= loading + rule_.periods; ++periods) {
    const double until = start_.time + periods * period_;
    while (simulation->time() < until) simulation->step(until);
    recent.push_back(simulation->positions());
    trial.displacement = largest_distance(start, recent.back());
    watch(periods, trial.displacement);
    if (trial.displacement > limit) {
      trial.verdict = Verdict::failed;
      break;
    }
    if (periods <= loading) recent.pop_front(); // the window begins with constant loads
    if (recent.size() <= rest_window) continue;
    if (largest_distance(recent.front(), recent.back()) <= rest_limit) {
      trial.verdict = Verdict::stable;
      break;
    }
    recent.pop_front();
  }

  for (const Monitor& monitor : scene.monitors)
    trial.monitor_displacement.push_back(
        distance(start, simulation->positions(), simulation->nearest_point(monitor.position)));
  trial.kinetic_energy = simulation->energies().kinetic;
  trial.time = simulation->time() - start_.time;
  trial.steps = simulation->steps() - start_.steps;
  trial.frame = io::frame_of(*simulation, scene);
  trial.wall = std::chrono::duration<double>(Clock::now() - begin).count();
  return trial;
}

} // namespace scarp::apps
