#include "render/node_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace scarp::render {

namespace {

/// Calls add(node, N_I(x_p), p) for the four nodes around every point of the grid.
template <class Add> void for_each_weight(const io::Frame& frame, const NodeField& grid, Add add) {
  const Point upper = grid.upper();
  for (std::size_t p = 0; p < frame.size(); ++p) {
    const double x = frame.position[3 * p];
    const double z = frame.position[3 * p + 2];
    if (!(Box{grid.lower, upper}.contains({x, z}))) continue;
    const double along = (x - grid.lower.x) / grid.cell_size;
    const double up = (z - grid.lower.y) / grid.cell_size;
    const std::size_t i = std::min(static_cast<std::size_t>(along), grid.nodes_x - 2);
    const std::size_t k = std::min(static_cast<std::size_t>(up), grid.nodes_z - 2);
    const double right = along - static_cast<double>(i);
    const double top = up - static_cast<double>(k);
    const std::size_t node = i + grid.nodes_x * k;
    add(node, (1.0 - right) * (1.0 - top), p);
    add(node + 1, right * (1.0 - top), p);
    add(node + grid.nodes_x, (1.0 - right) * top, p);
    add(node + grid.nodes_x + 1, right * top, p);
  }
}

/// Nodes that are not known yet take the mean of their known neighbours.
void extend(NodeField& field, std::vector<char>& known) {
  const std::vector<char> before = known;
  for (std::size_t k = 0; k < field.nodes_z; ++k) {
    for (std::size_t i = 0; i < field.nodes_x; ++i) {
      if (before[i + field.nodes_x * k]) continue;
      double sum = 0.0;
      int count = 0;
      for (std::size_t l = k > 0 ? k - 1 : 0; l <= std::min(k + 1, field.nodes_z - 1); ++l) {
        for (std::size_t j = i > 0 ? i - 1 : 0; j <= std::min(i + 1, field.nodes_x - 1); ++j) {
          if (!before[j + field.nodes_x * l]) continue;
          sum += field.at(j, l);
          ++count;
        }
      }
      if (count == 0) continue;
      field.at(i, k) = sum / count;
      known[i + field.nodes_x * k] = 1;
    }
  }
}

/// A line of a refined field: which nodes of the coarse one with which weights.
struct Stencil {
  std::size_t first = 0;
  std::size_t count = 0;
  std::array<double, 3> weights = {0.0, 0.0, 0.0};
};

NodeField resampled(const NodeField& field, std::size_t times, const std::vector<Stencil>& columns,
                    const std::vector<Stencil>& rows) {
  NodeField along = field; // refined in x only
  along.nodes_x = columns.size();
  along.values.assign(along.nodes_x * field.nodes_z, 0.0);
  for (std::size_t k = 0; k < field.nodes_z; ++k)
    for (std::size_t i = 0; i < along.nodes_x; ++i)
      for (std::size_t j = 0; j < columns[i].count; ++j)
        along.at(i, k) += columns[i].weights[j] * field.at(columns[i].first + j, k);
  NodeField fine = along;
  fine.cell_size = field.cell_size / static_cast<double>(times);
  fine.nodes_z = rows.size();
  fine.values.assign(fine.nodes_x * fine.nodes_z, 0.0);
  for (std::size_t k = 0; k < fine.nodes_z; ++k)
    for (std::size_t j = 0; j < rows[k].count; ++j)
      for (std::size_t i = 0; i < fine.nodes_x; ++i)
        fine.at(i, k) += rows[k].weights[j] * along.at(i, rows[k].first + j);
  return fine;
}

std::vector<Stencil> linear_stencils(std::size_t nodes, std::size_t times) {
  std::vector<Stencil> lines;
  for (std::size_t fine = 0; fine <= (nodes - 1) * times; ++fine) {
    const std::size_t first = std::min(fine / times, nodes - 2);
    const double part = static_cast<double>(fine - first * times) / static_cast<double>(times);
    lines.push_back({first, 2, {1.0 - part, part, 0.0}});
  }
  return lines;
}

/// Quadratic B-spline; at the grid's sides the missing node repeats the side's own value.
std::vector<Stencil> spline_stencils(std::size_t nodes, std::size_t times) {
  std::vector<Stencil> lines;
  for (std::size_t fine = 0; fine <= (nodes - 1) * times; ++fine) {
    const double place = static_cast<double>(fine) / static_cast<double>(times);
    const std::size_t nearest = (fine + times / 2) / times;
    const double r = place - static_cast<double>(nearest); // -1/2...1/2
    const double left = 0.5 * (0.5 - r) * (0.5 - r);
    const double right = 0.5 * (0.5 + r) * (0.5 + r);
    const double middle = 0.75 - r * r;
    if (nearest == 0)
      lines.push_back({0, 2, {left + middle, right, 0.0}});
    else if (nearest + 1 == nodes)
      lines.push_back({nearest - 1, 2, {left, middle + right, 0.0}});
    else
      lines.push_back({nearest - 1, 3, {left, middle, right}});
  }
  return lines;
}

} // namespace

NodeField node_grid(const io::Frame& frame) {
  if (frame.dimension != 2)
    throw std::invalid_argument(
        fmt::format("a plane-strain frame is wanted, this one has {} dimensions", frame.dimension));
  const double cells_x = (frame.upper[0] - frame.lower[0]) / frame.cell_size;
  const double cells_z = (frame.upper[2] - frame.lower[2]) / frame.cell_size;
  if (!(frame.cell_size > 0.0) || !(cells_x > 0.5) || !(cells_z > 0.5))
    throw std::invalid_argument(fmt::format(
        "the frame's grid has no cell: x {}...{} m, z {}...{} m, cell size {} m", frame.lower[0],
        frame.upper[0], frame.lower[2], frame.upper[2], frame.cell_size));
  NodeField grid;
  grid.lower = {frame.lower[0], frame.lower[2]};
  grid.cell_size = frame.cell_size;
  grid.nodes_x = static_cast<std::size_t>(std::lround(cells_x)) + 1;
  grid.nodes_z = static_cast<std::size_t>(std::lround(cells_z)) + 1;
  grid.values.assign(grid.nodes_x * grid.nodes_z, 0.0);
  return grid;
}

const std::vector<double>& initial_volumes(const io::Frame& frame) {
  return frame.column(frame.has("initial_volume") ? "initial_volume" : "volume").values;
}

NodeField volume_fraction(const io::Frame& frame) {
  NodeField fraction = node_grid(frame);
  const std::vector<double>& V0 = initial_volumes(frame);
  for_each_weight(frame, fraction, [&](std::size_t node, double N, std::size_t p) {
    fraction.values[node] += V0[p] * N;
  });
  for (std::size_t k = 0; k < fraction.nodes_z; ++k) {
    for (std::size_t i = 0; i < fraction.nodes_x; ++i) {
      const double part_x = i == 0 || i + 1 == fraction.nodes_x ? 0.5 : 1.0;
      const double part_z = k == 0 || k + 1 == fraction.nodes_z ? 0.5 : 1.0;
      fraction.at(i, k) /= part_x * part_z * frame.cell_size * frame.cell_size;
    }
  }
  return fraction;
}

NodeField node_average(const io::Frame& frame, const std::vector<double>& values) {
  if (values.size() != frame.size())
    throw std::invalid_argument(
        fmt::format("{} values for {} points", values.size(), frame.size()));
  NodeField average = node_grid(frame);
  std::vector<double> weight(average.values.size(), 0.0);
  const std::vector<double>& V0 = initial_volumes(frame);
  for_each_weight(frame, average, [&](std::size_t node, double N, std::size_t p) {
    average.values[node] += V0[p] * N * values[p];
    weight[node] += V0[p] * N;
  });
  std::vector<char> known(weight.size(), 0);
  for (std::size_t node = 0; node < weight.size(); ++node) {
    if (weight[node] <= 0.0) continue;
    average.values[node] /= weight[node];
    known[node] = 1;
  }
  extend(average, known);
  extend(average, known);
  return average;
}

NodeField refined(const NodeField& field, std::size_t times) {
  return resampled(field, times, linear_stencils(field.nodes_x, times),
                   linear_stencils(field.nodes_z, times));
}

NodeField refined_smooth(const NodeField& field, std::size_t times) {
  return resampled(field, times, spline_stencils(field.nodes_x, times),
                   spline_stencils(field.nodes_z, times));
}

} // namespace scarp::render
