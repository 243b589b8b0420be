#include "apps/stress_draft.hpp"

#include "core/drucker_prager.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scarp::apps {

namespace {

constexpr double standard_gravity = 9.81; // m/s2

} // namespace

StressDraft::StressDraft(Preset preset, std::uint64_t seed, std::size_t number)
    : random_(seed, number) {
  start_grid();
  start_body();
  choose_gravity();
  choose_method(preset);
}

Scene StressDraft::finish() {
  close_grid();
  scale();
  choose_time();
  return scene_;
}

void StressDraft::start_grid() {
  Grid& grid = scene_.grid;
  grid.dimension = random_.chance(0.15) ? 3 : 2;
  grid.cell_size = random_.log_between(0.01, 1.0);
  grid.points_per_cell = random_.whole(1, grid.dimension == 3 ? 2 : 4);
  for (double& corner : grid.lower) corner = random_.between(-10.0, 10.0);
}

void StressDraft::start_body() {
  const Grid& grid = scene_.grid;
  if (grid.dimension == 3) depth_ = random_.between(0.6, 3.0);
  const double points = random_.log_between(60.0, 400.0);
  const double area = points / std::pow(grid.points_per_cell, grid.dimension) / depth_;
  width_ = std::clamp(std::sqrt(area * random_.log_between(0.2, 5.0)), 0.8, 40.0);
  height_ = std::clamp(area / width_, 0.8, 40.0);
  x_ = random_.whole(1, 6) + random_.between(0.0, 1.0);
  z_ = random_.chance(0.6) ? 0.0 : random_.between(0.0, 3.0);
  stiffness_ = random_.log_between(0.1, 1e5);
}

void StressDraft::choose_gravity() {
  const double tilt = random_.chance(0.4) ? random_.between(-0.6, 0.6) : 0.0;
  const double g = standard_gravity * (random_.chance(0.5) ? 1.0 : random_.log_between(0.1, 10.0));
  scene_.gravity = {g * std::sin(tilt), 0.0, -g * std::cos(tilt)};
}

void StressDraft::choose_method(Preset preset) {
  Method& method = scene_.method = method_of(preset);
  // Of the published ones; usl is left out: it is known to throw points (its strain follows light
  // nodes).
  const bool usf = !random_.chance(0.7);
  if (usf && preset == Preset::fidelity) method.scheme = Scheme::usf;
  const double flip = random_.chance(0.4) ? 1.0 : random_.between(0.9, 1.0);
  if (preset == Preset::fidelity) method.flip = flip;
  method.local_damping = random_.chance(0.2) ? random_.between(0.0, 0.5) : 0.0;
  scene_.timing.cfl = random_.between(0.1, 0.9);
}

std::string StressDraft::material(double contrast) {
  Material made;
  made.name = "material" + std::to_string(scene_.materials.size());
  made.density = scene_.materials.empty() ? random_.between(500.0, 3000.0)
                                          : contrast * scene_.materials[0].density;
  // By the weight of the first material over the body's height: 1 is squeezed flat.
  const double g = std::hypot(scene_.gravity[0], scene_.gravity[2]);
  const double weight = made.density / contrast * g * height_ * scene_.grid.cell_size;
  made.youngs_modulus = stiffness_ * weight;
  if (contrast != 1.0) made.youngs_modulus *= random_.log_between(0.1, 10.0);
  made.poissons_ratio = random_.between(0.0, 0.49);
  if (!random_.chance(0.25)) made.law = soil(weight);
  scene_.materials.push_back(made);
  return made.name;
}

DruckerPrager StressDraft::soil(double weight) {
  DruckerPrager law;
  law.friction_angle = random_.between(0.0, 50.0);
  law.cohesion = random_.chance(0.4)   ? 0.0
                 : random_.chance(0.5) ? random_.log_between(1.0, 1e6)
                                       : weight * random_.log_between(1e-3, 1.0);
  if (random_.chance(0.4))
    law.dilation_angle = random_.between(0.0, std::min(20.0, law.friction_angle));
  law.cone = static_cast<Cone>(random_.whole(0, 2));
  if (random_.chance(0.2)) law.tension_cutoff = random_.between(0.0, law.cohesion);
  law.opening = random_.chance(0.5) ? Opening::forgotten : Opening::remembered;
  return law;
}

std::array<double, 3> StressDraft::speed(double part_of_wave) {
  const Material& of = scene_.materials.back();
  const double v =
      random_.log_between(1e-3, 1.0) * part_of_wave * std::sqrt(of.youngs_modulus / of.density);
  const double angle = random_.between(-3.14159265358979, 3.14159265358979);
  const double across = scene_.grid.dimension == 3 ? random_.between(-0.5, 0.5) : 0.0;
  return {v * std::cos(angle), v * across, v * std::sin(angle)};
}

void StressDraft::add(Shape shape, const std::string& material, std::array<double, 3> velocity) {
  Region region;
  region.name = "region" + std::to_string(scene_.regions.size());
  region.material = material;
  region.polygon = std::move(shape);
  region.velocity = velocity;
  scene_.regions.push_back(region);
}

Wall StressDraft::wall() {
  const double draw = random_.between(0.0, 1.0);
  if (draw < 0.35) return {WallKind::fixed};
  if (draw < 0.6) return {WallKind::symmetry};
  if (draw < 0.9) return {WallKind::friction, random_.between(0.0, 1.0)};
  return {WallKind::free};
}

/// Around the body, with some room; the base is closed more often than not.
void StressDraft::close_grid() {
  double right = 0.0;
  double top = 0.0;
  for (const Region& region : scene_.regions)
    for (const auto& corner : region.polygon) {
      right = std::max(right, corner[0]);
      top = std::max(top, corner[1]);
    }
  cells_ = {std::ceil(right) + (confined_ ? 0 : random_.whole(2, 12)),
            std::ceil(depth_) + (confined_ ? 0 : random_.whole(0, 3)),
            std::ceil(top) + random_.whole(2, 8)};
  auto& walls = scene_.grid.walls;
  for (auto& sides : walls)
    for (Wall& side : sides) side = confined_ ? Wall{WallKind::symmetry} : wall();
  if (random_.chance(0.7)) walls[2][0] = {WallKind::fixed};
  if (random_.chance(0.5)) walls[2][1] = {WallKind::free};
}

void StressDraft::scale() {
  Grid& grid = scene_.grid;
  const double h = grid.cell_size;
  for (std::size_t i = 0; i < 3; ++i) grid.upper[i] = grid.lower[i] + h * cells_[i];
  for (Region& region : scene_.regions) {
    for (auto& corner : region.polygon)
      corner = {grid.lower[0] + h * corner[0], grid.lower[2] + h * corner[1]};
    if (grid.dimension == 3)
      region.depth = {grid.lower[1], std::min(grid.lower[1] + h * depth_, grid.upper[1])};
  }
  if (gate_ > 0.0) scene_.gates = {{"gate", 0, grid.lower[0] + h * gate_, 0.0}};
}

/// From the number of steps, with the shortest step that a fall through the grid leaves.
void StressDraft::choose_time() {
  double fastest = 0.0; // wave, m/s
  for (const Material& material : scene_.materials) {
    const auto moduli = ElasticModuli::from(material.youngs_modulus, material.poissons_ratio);
    fastest = std::max(fastest, std::sqrt(moduli.p_wave() / material.density));
  }
  double thrown = 0.0; // m/s
  for (const Region& region : scene_.regions)
    thrown =
        std::max(thrown, std::hypot(region.velocity[0], region.velocity[1], region.velocity[2]));
  const Grid& grid = scene_.grid;
  double fall = 0.0; // m2/s2
  for (const std::size_t i : {0U, 2U})
    fall += std::abs(scene_.gravity[i]) * (grid.upper[i] - grid.lower[i]);
  const double steps = confined_ ? 3000.0 : random_.log_between(200.0, 3000.0);
  const double end = steps * scene_.timing.cfl * grid.cell_size /
                     (fastest + std::sqrt(thrown * thrown + 2.0 * fall));
  scene_.timing.output_interval = end;
  scene_.timing.history_interval = end;
  if (scene_.stages.empty()) scene_.timing.end_time = end;
  for (Stage& stage : scene_.stages) {
    stage.duration *= end;
    for (auto& point : stage.gravity.points) point[0] *= end;
    for (auto& [region, ramp] : stage.body_force)
      for (auto& point : ramp.points) point[0] *= end;
  }
  // The stages' durations may add up to a little less.
  if (!scene_.stages.empty()) scene_.timing.output_interval = 0.5 * end;
  for (Gate& gate : scene_.gates) gate.release_time = end * random_.between(0.1, 0.5);
}

} // namespace scarp::apps
