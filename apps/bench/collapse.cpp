#include "apps/bench/collapse.hpp"

#include "apps/bench/prepared.hpp"

#include <algorithm>
#include <cmath>

namespace scarp::bench {

namespace {

constexpr double height = 0.2;          // m
constexpr double front_speed = 0.5;     // m/s
constexpr double gravity = 9.81;        // m/s2
constexpr double friction_angle = 19.8; // degrees
constexpr std::size_t length_over_height = 2;
constexpr double spare_width = 2.0; // grid over block
constexpr double spare_height = 1.25;

Material rods() {
  DruckerPrager law;
  law.friction_angle = friction_angle;
  law.opening = Opening::remembered;
  return {"rods", 2650.0, 0.84e6, 0.3, law};
}

} // namespace

std::size_t CollapseSize::points() const {
  const auto n = static_cast<std::size_t>(cells_high);
  return dimension == 2 ? 4 * length_over_height * n * n : 8 * length_over_height * n * n * n;
}

CollapseSize collapse_of(int dimension, double points) {
  const auto unit = static_cast<double>(CollapseSize{dimension, 1}.points());
  return {dimension,
          std::max(1, static_cast<int>(std::lround(std::pow(points / unit, 1.0 / dimension))))};
}

Scene collapse_scene(const CollapseSize& size, const Method& method) {
  const double h = height / size.cells_high;
  const double length = static_cast<double>(length_over_height) * height;
  const auto whole_cells = [&](double x) { return h * std::ceil(x / h - 1e-9); };
  Scene scene;
  scene.title = "collapsing block of rods";
  scene.grid =
      plane_grid(h, {0.0, 0.0}, {spare_width * length, whole_cells(spare_height * height)});
  scene.grid.dimension = size.dimension;
  scene.grid.upper[1] = height;
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  for (Wall& side : scene.grid.walls[1]) side.kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.gravity = {0.0, 0.0, -gravity};
  scene.materials = {rods()};
  scene.regions = {box("block", "rods", {0.0, 0.0}, {length, height})};
  scene.regions.front().depth = {0.0, height};
  scene.method = method;
  return scene;
}

Snapshot collapse_start(const CollapseSize& size) {
  const Scene scene = collapse_scene(size, {});
  Snapshot start = at_rest(*make_simulation(scene));
  const double rate =
      front_speed / (static_cast<double>(length_over_height) * height); // 1/s, of extension
  const double sine = std::sin(friction_angle * 3.14159265358979323846 / 180.0);
  const double active = (1.0 - sine) / (1.0 + sine);
  for (std::size_t p = 0; p < start.volume.size(); ++p) {
    const double x = start.position[3 * p], z = start.position[3 * p + 2];
    start.velocity[3 * p] = rate * x;
    start.velocity[3 * p + 2] = -rate * z;
    start.velocity_gradient[9 * p] = rate;
    start.velocity_gradient[9 * p + 8] = -rate;
    const double vertical = -scene.materials.front().density * gravity * (height - z);
    start.stress[6 * p] = start.stress[6 * p + 1] = active * vertical;
    start.stress[6 * p + 2] = vertical;
  }
  return start;
}

std::unique_ptr<Simulation> begin_collapse(const CollapseSize& size, const Method& method,
                                           const Snapshot& start) {
  return begin_from(collapse_scene(size, method), start);
}

double yielded_part(const Simulation& simulation) {
  const std::vector<double> strain = simulation.field("equivalent_plastic_strain");
  const auto yielded = std::ranges::count_if(strain, [](double e) { return e > 0.0; });
  return static_cast<double>(yielded) / static_cast<double>(strain.size());
}

} // namespace scarp::bench
