#include "apps/bench/vortex.hpp"

#include "apps/bench/prepared.hpp"

#include <cmath>
#include <numbers>

namespace scarp::bench {

namespace {

constexpr double density = 1000.0;     // kg/m3
constexpr double modulus = 1000.0;     // Pa
constexpr double poissons_ratio = 0.3; // -
constexpr double shear = modulus / (2.0 * (1.0 + poissons_ratio));
constexpr double half_width = 0.5; // m, a above: the ring lies between 0.5 and 1.5 m
constexpr double duration = 1.0;   // s, T

/// A function and its first two derivatives.
struct Value {
  double of, first, second;
};

/// Of alpha's part h over R.
Value profile(double radius) {
  const double s = (radius - 1.0) / half_width;
  if (std::abs(s) >= 1.0) return {0.0, 0.0, 0.0};
  const double q = 1.0 - s * s;
  return {q * q * q * q, -8.0 * s * q * q * q / half_width,
          (-8.0 * q * q * q + 48.0 * s * s * q * q) / (half_width * half_width)};
}

/// Of alpha's part g over t.
Value course(double amplitude, double time) {
  const double k = std::numbers::pi / duration;
  const double s = std::sin(k * time);
  const double c = std::cos(k * time);
  return {amplitude * s * s * s * s, 4.0 * amplitude * k * s * s * s * c,
          4.0 * amplitude * k * k * s * s * (3.0 * c * c - s * s)};
}

Scene scene_of(const Vortex& vortex, int cells, const Discretisation& how) {
  const double h = 1.0 / cells;
  constexpr double half = 1.75; // m: the ring and a quarter of a metre at rest around it
  const double rim = std::ceil((half + 0.5) * cells) * h;
  Scene scene;
  scene.grid = plane_grid(h, {-rim, -rim}, {rim, rim});
  scene.grid.points_per_cell = how.points_per_cell;
  scene.materials = {{"ring", density, modulus, poissons_ratio, LinearElastic{}}};
  scene.gravity = {0.0, 0.0, 0.0};
  scene.body_force = [vortex](const std::array<double, 3>& place, double time) {
    return vortex.force(place, time);
  };
  scene.method = how.method;
  scene.timing.cfl = how.cfl;
  scene.regions = {box("ring", "ring", {-half, -half}, {half, half})};
  return scene;
}

} // namespace

std::array<double, 3> Vortex::position(const std::array<double, 3>& place, double time) const {
  const double alpha = course(amplitude, time).of * profile(std::hypot(place[0], place[2])).of;
  const double c = std::cos(alpha);
  const double s = std::sin(alpha);
  return {c * place[0] - s * place[2], 0.0, s * place[0] + c * place[2]};
}

std::array<double, 3> Vortex::force(const std::array<double, 3>& place, double time) const {
  const double radius = std::hypot(place[0], place[2]);
  if (std::abs(radius - 1.0) >= half_width) return {0.0, 0.0, 0.0};
  const Value h = profile(radius);
  const Value g = course(amplitude, time);
  const double omega = g.first * h.of;
  const double gamma = radius * g.of * h.first;
  const double gamma_R = g.of * (h.first + radius * h.second);
  const double div_r =
      -shear * (std::sin(gamma) * gamma_R + 2.0 * (1.0 - std::cos(gamma)) / radius);
  const double div_t = shear * (std::cos(gamma) * gamma_R + 2.0 * std::sin(gamma) / radius);
  const double b_r = -radius * omega * omega - div_r / density;
  const double b_t = radius * g.second * h.of - div_t / density;
  const double c = place[0] / radius;
  const double s = place[2] / radius;
  return {b_r * c - b_t * s, 0.0, b_r * s + b_t * c};
}

std::array<double, 3> Vortex::stress(double radius, double time) const {
  const double gamma = radius * course(amplitude, time).of * profile(radius).first;
  const double difference = shear * (1.0 - std::cos(gamma));
  return {-difference, difference, shear * std::sin(gamma)};
}

VortexRun run_vortex(const Vortex& vortex, int cells, const Discretisation& how) {
  constexpr double end = 0.5 * duration;
  const auto simulation = make_simulation(scene_of(vortex, cells, how));
  const std::vector<double> start = simulation->positions();
  const std::vector<double> volume = simulation->field("initial_volume");
  run_until(*simulation, end);

  const std::vector<double> x = simulation->positions();
  const std::vector<double> stress = simulation->field("stress");
  double error2 = 0.0, size2 = 0.0, stress_error2 = 0.0, stress_size2 = 0.0;
  for (std::size_t p = 0; p < volume.size(); ++p) {
    const std::array<double, 3> from = {start[3 * p], 0.0, start[3 * p + 2]};
    const std::array<double, 3> to = vortex.position(from, end);
    for (const std::size_t i : {0U, 2U}) {
      error2 += volume[p] * std::pow(x[3 * p + i] - to[i], 2);
      size2 += volume[p] * std::pow(to[i] - from[i], 2);
    }
    const double radius = std::hypot(to[0], to[2]);
    const double c = to[0] / radius;
    const double s = to[2] / radius;
    // e_r . sigma e_theta
    const double xx = stress[6 * p], zz = stress[6 * p + 2], xz = stress[6 * p + 5];
    const double rt = c * s * (zz - xx) + (c * c - s * s) * xz;
    const double exact = vortex.stress(radius, end)[2];
    stress_error2 += volume[p] * std::pow(rt - exact, 2);
    stress_size2 += volume[p] * exact * exact;
  }
  return {std::sqrt(error2 / size2), std::sqrt(stress_error2 / stress_size2), volume.size(),
          simulation->steps()};
}

} // namespace scarp::bench
