// An elastic block on a plane with Coulomb friction, inclined by beta (gravity is turned, not the
// grid): it accelerates by g (sin beta - mu cos beta), and sticks where mu > tan beta.
//
// Of the mean velocity: each node on the plane takes the normal impulse P >= 0 and at most mu P
// along it, so v_x + mu v_z >= v_0 + g (sin - mu cos) t, with equality as long as all slide.
#include "apps/bench/cases.hpp"
#include "apps/bench/prepared.hpp"

#include <cmath>
#include <numbers>

namespace scarp::bench {

namespace {

constexpr double g = 10.0; // m/s2
constexpr double sine = 0.6, cosine = 0.8;
constexpr double duration = 0.5; // s

struct Slide {
  std::vector<double> time, velocity; ///< s, m/s of the centre of mass, along the plane
  double path = 0.0;                  ///< m
  double acceleration = 0.0;          ///< m/s2, by least squares of v = a t
};

Slide slide(double friction, double damping) {
  Scene scene;
  scene.grid = plane_grid(0.1, {0.0, 0.0}, {4.0, 0.8});
  scene.grid.walls[2][0] = {WallKind::friction, friction};
  scene.materials = {{"block", 1000.0, 1e6, 0.2, LinearElastic{}}};
  scene.gravity = {g * sine, 0.0, -g * cosine};
  scene.method.local_damping = damping;
  scene.regions = {box("block", "block", {0.5, 0.0}, {0.9, 0.2})};
  const auto simulation = make_simulation(scene);
  const std::vector<double> m = masses(*simulation);
  double mass = 0.0;
  for (const double one : m) mass += one;
  Slide result;
  double vt = 0.0, tt = 0.0;
  constexpr int samples = 50;
  for (int sample = 1; sample <= samples; ++sample) {
    const double t = duration * sample / samples;
    run_until(*simulation, t);
    const std::vector<double> v = simulation->field("velocity");
    double momentum = 0.0;
    for (std::size_t p = 0; p < m.size(); ++p) momentum += m[p] * v[3 * p];
    result.time.push_back(t);
    result.velocity.push_back(momentum / mass);
    vt += t * momentum / mass;
    tt += t * t;
  }
  const std::vector<double> u = simulation->field("displacement");
  for (std::size_t p = 0; p < m.size(); ++p) result.path += m[p] * u[3 * p] / mass;
  result.acceleration = vt / tt;
  return result;
}

} // namespace

CaseReport block_case(Effort) {
  constexpr double slips = 0.3, sticks = 1.5;
  const Slide sliding = slide(slips, 0.0);
  const Slide sticking = slide(sticks, 0.3);
  const double exact = g * (sine - slips * cosine);
  CaseReport report;
  report.checks = {{"acceleration", sliding.acceleration, exact, 0.02, Bound::relative, "m/s²",
                    "Coulomb: g (sin - mu cos)", "mu = 0.3 on a slope of 3:4"},
                   // It shears by tau H / G = 1.2 kPa 0.2 m / 0.42 MPa, 0.6 mm at the top.
                   {"creep_when_stuck", sticking.path, 0.0, 2e-3, Bound::absolute, "m",
                    "mu > tan(beta): no motion but elastic shear, below 0.6 mm",
                    "mu = 1.5, damped, after 0.5 s"}};
  report.figure = {
      {{{.label = "g (sin β − μ cos β) t",
         .x = {0.0, duration},
         .y = {0.0, exact * duration},
         .colour = render::ink,
         .line = render::LineKind::dotted},
        {.label = "scarp, μ = 0.3", .x = sliding.time, .y = sliding.velocity},
        {.label = "scarp, μ = 1.5", .x = sticking.time, .y = sticking.velocity}},
       {.x_name = "time", .x_unit = "s", .y_name = "velocity along the plane", .y_unit = "m/s"}}};
  report.caption = "A block on an inclined plane with friction (slope 3:4).";
  return report;
}

} // namespace scarp::bench
