// Tiny scenes for the tests of the solver, and what they measure on them.
#pragma once

#include "core/scene.hpp"
#include "core/simulation.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace scarp::test {

inline Material elastic(const std::string& name, double density, double youngs_modulus,
                        double poissons_ratio) {
  return {name, density, youngs_modulus, poissons_ratio, LinearElastic{}};
}

/// A box x0..x1 by z0..z1, in 3-D y0..y1 deep.
inline Region box(const std::string& name, const std::string& material, std::array<double, 2> lower,
                  std::array<double, 2> upper, std::array<double, 3> velocity = {0, 0, 0},
                  std::array<double, 2> depth = {0, 0}) {
  Region region;
  region.name = name;
  region.material = material;
  region.polygon = {
      {lower[0], lower[1]}, {upper[0], lower[1]}, {upper[0], upper[1]}, {lower[0], upper[1]}};
  region.depth = depth;
  region.velocity = velocity;
  return region;
}

/// A plane-strain grid from (x0, z0) to (x1, z1) with free sides.
inline Grid grid_2d(double cell_size, std::array<double, 2> lower, std::array<double, 2> upper) {
  Grid grid;
  grid.dimension = 2;
  grid.cell_size = cell_size;
  grid.lower = {lower[0], 0.0, lower[1]};
  grid.upper = {upper[0], 0.0, upper[1]};
  return grid;
}

inline Grid grid_3d(double cell_size, std::array<double, 3> lower, std::array<double, 3> upper) {
  Grid grid;
  grid.dimension = 3;
  grid.cell_size = cell_size;
  grid.lower = lower;
  grid.upper = upper;
  return grid;
}

/// The aluminium rods of Bui et al. 2008: K = 0.7 MPa, nu = 0.3, so E = 3 K (1 - 2 nu) = 0.84 MPa.
inline Material rods() {
  DruckerPrager law;
  law.friction_angle = 19.8;
  return {"rods", 2650.0, 0.84e6, 0.3, law};
}

/// A pile of rods against a smooth wall at x = 0 on a fixed base, let go at time 0.
inline Scene pile(double width, double height, double cell_size, double room_width,
                  double room_height) {
  Scene scene;
  scene.grid = grid_2d(cell_size, {0.0, 0.0}, {room_width, room_height});
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.materials = {rods()};
  scene.regions = {box("pile", "rods", {0.0, 0.0}, {width, height})};
  return scene;
}

/// A box in the middle of a wide grid with free sides; 1 kPa keeps its step at about 10 ms.
inline Scene free_block(std::array<double, 3> velocity, std::array<double, 3> gravity) {
  Scene scene;
  scene.grid = grid_2d(0.1, {-2.0, -2.0}, {2.0, 2.0});
  scene.materials = {elastic("foam", 1000.0, 1e3, 0.2)};
  scene.regions = {box("block", "foam", {-0.25, -0.25}, {0.25, 0.15}, velocity)};
  scene.gravity = gravity;
  return scene;
}

/// 40 mm x 20 mm of rods in 5 mm cells: 128 points.
inline Scene small_pile() { return pile(0.04, 0.02, 0.005, 0.12, 0.04); }

inline void run_until(Simulation& simulation, double time) {
  while (simulation.time() < time) simulation.step(time);
}

/// Component `c` of `components`, point by point.
inline std::vector<double> component_of(const std::vector<double>& values, std::size_t components,
                                        std::size_t c) {
  std::vector<double> column;
  for (std::size_t i = c; i < values.size(); i += components) column.push_back(values[i]);
  return column;
}

inline double sum(const auto& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

/// Mass of each point: kg, per metre of depth in plane strain.
inline std::vector<double> masses(const Simulation& simulation) {
  std::vector<double> mass = simulation.field("density");
  const std::vector<double> volume = simulation.field("volume");
  for (std::size_t p = 0; p < mass.size(); ++p) mass[p] *= volume[p];
  return mass;
}

/// Velocity of the centre of mass, m/s, component `axis` of x y z.
inline double mean_velocity(const Simulation& simulation, std::size_t axis) {
  const std::vector<double> mass = masses(simulation);
  const std::vector<double> v = component_of(simulation.field("velocity"), 3, axis);
  double momentum = 0.0;
  for (std::size_t p = 0; p < mass.size(); ++p) momentum += mass[p] * v[p];
  return momentum / sum(mass);
}

/// Seeded numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

} // namespace scarp::test
