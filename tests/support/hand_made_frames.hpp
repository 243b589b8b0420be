// Tiny frames whose measures are known in closed form; never the output of a solver.
#pragma once

#include "io/frame.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace scarp::test {

/// A plane-strain grid without points: x 0...length, z 0...height (m).
inline io::Frame empty_frame(double cell_size, double length, double height) {
  io::Frame frame;
  frame.cell_size = cell_size;
  frame.upper = {length, 0.0, height};
  frame.columns.push_back({"initial_volume", 1, {}});
  return frame;
}

/// m; `volume` in m2.
inline void add_point(io::Frame& frame, double x, double z, double volume) {
  frame.position.insert(frame.position.end(), {x, 0.0, z});
  frame.columns.front().values.push_back(volume);
}

/// Two by two points a cell wherever `inside` holds.
inline void fill(io::Frame& frame, const std::function<bool(double x, double z)>& inside) {
  const double spacing = 0.5 * frame.cell_size;
  const auto columns = std::lround(frame.upper[0] / spacing);
  const auto rows = std::lround(frame.upper[2] / spacing);
  for (long row = 0; row < rows; ++row) {
    for (long column = 0; column < columns; ++column) {
      const double x = (static_cast<double>(column) + 0.5) * spacing;
      const double z = (static_cast<double>(row) + 0.5) * spacing;
      if (inside(x, z)) add_point(frame, x, z, spacing * spacing);
    }
  }
}

inline io::Frame rectangle(double cell_size, double length, double height) {
  io::Frame frame = empty_frame(cell_size, 2.0 * length, 2.0 * height);
  fill(frame, [&](double x, double z) { return x < length && z < height; });
  return frame;
}

inline void add_column(io::Frame& frame, std::string name, int components,
                       std::vector<double> values) {
  frame.columns.push_back({std::move(name), components, std::move(values)});
}

/// A pile 0.2 m by 0.1 m whose part above the line from (0.02, 0.1) to (0.18, 0) has sheared
/// outwards; `progress` 0...1.  Columns as a solver would write them.
inline io::Frame slumped_pile(double progress) {
  io::Frame frame = empty_frame(0.005, 0.4, 0.12);
  fill(frame, [](double x, double z) { return x < 0.2 && z < 0.1; });
  frame.time = 0.6 * progress;
  std::vector<double> displacement;
  std::vector<double> velocity;
  std::vector<double> strain;
  std::vector<double> mean_stress;
  std::vector<double> region;
  for (std::size_t p = 0; p < frame.size(); ++p) {
    double& x = frame.position[3 * p];
    double& z = frame.position[3 * p + 2];
    const double line = 0.1 - 0.1 / 0.16 * (x - 0.02);
    const double above = z - line;
    region.push_back(above > 0.0 ? 2.0 : 1.0);
    mean_stress.push_back(-2650.0 * 9.8 * (0.1 - z) * 0.7);
    strain.push_back(progress * 1.2 * std::exp(-std::pow(above / 0.02, 2)));
    const double slide = above > 0.0 ? 0.6 * progress * above : 0.0;
    const double sink = above > 0.0 ? 0.3 * progress * above * x / 0.2 : 0.0;
    x += slide;
    z -= sink;
    displacement.insert(displacement.end(), {slide, 0.0, -sink});
    velocity.insert(velocity.end(), {4.0 * slide, 0.0, -4.0 * sink});
  }
  add_column(frame, "displacement", 3, std::move(displacement));
  add_column(frame, "velocity", 3, std::move(velocity));
  add_column(frame, "equivalent_plastic_strain", 1, std::move(strain));
  add_column(frame, "mean_stress", 1, std::move(mean_stress));
  add_column(frame, "region", 1, std::move(region));
  return frame;
}

/// A heap in a box of 2 m x 1 m x 1 m with its height as `velocity`.
inline io::Frame heap() {
  io::Frame frame;
  frame.dimension = 3;
  frame.cell_size = 0.1;
  frame.upper = {2.0, 1.0, 1.0};
  frame.time = 0.5;
  std::vector<double> volume;
  std::vector<double> velocity;
  const double spacing = 0.05;
  for (double x = 0.5 * spacing; x < 2.0; x += spacing) {
    for (double y = 0.5 * spacing; y < 1.0; y += spacing) {
      for (double z = 0.5 * spacing; z < 1.0; z += spacing) {
        if (z > 0.8 * std::exp(-x * x - 2.0 * (y - 0.5) * (y - 0.5))) continue;
        frame.position.insert(frame.position.end(), {x, y, z});
        volume.push_back(spacing * spacing * spacing);
        velocity.insert(velocity.end(), {z, 0.0, 0.0});
      }
    }
  }
  add_column(frame, "initial_volume", 1, std::move(volume));
  add_column(frame, "velocity", 3, std::move(velocity));
  return frame;
}

} // namespace scarp::test
