// A plane-strain frame's points carried to the nodes of its grid.
#pragma once

#include "io/frame.hpp"
#include "render/geometry.hpp"

#include <cstddef>
#include <vector>

namespace scarp::render {

/// Values on the nodes of a regular grid in the x-z plane, bilinear in between.
struct NodeField {
  Point lower;            ///< m, the first node
  double cell_size = 0.0; ///< m
  std::size_t nodes_x = 0;
  std::size_t nodes_z = 0;
  std::vector<double> values; ///< values[i + nodes_x * k]

  double at(std::size_t i, std::size_t k) const { return values[i + nodes_x * k]; }
  double& at(std::size_t i, std::size_t k) { return values[i + nodes_x * k]; }
  double x(std::size_t i) const { return lower.x + cell_size * static_cast<double>(i); }
  double z(std::size_t k) const { return lower.y + cell_size * static_cast<double>(k); }
  Point upper() const { return {x(nodes_x - 1), z(nodes_z - 1)}; }
};

/// The nodes of the frame's grid, all values zero.  Throws std::invalid_argument if the frame is
/// not plane strain or its grid has no cell.
NodeField node_grid(const io::Frame& frame);

/// Undeformed volumes of the points, m3 (m2 in plane strain: per metre of depth): the column
/// `initial_volume`, else `volume`.  Throws std::runtime_error if there is neither.
const std::vector<double>& initial_volumes(const io::Frame& frame);

/// phi_I = sum_p V0_p N_I(x_p) / V_I with bilinear N_I; V_I is h^2, half of it on a side of the
/// grid and a quarter in its corners.  Points outside the grid do not count.
NodeField volume_fraction(const io::Frame& frame);

/// The body is where the volume fraction is this and more.
inline constexpr double body_level = 0.5;

/// s_I = sum_p V0_p N_I(x_p) s_p / sum_p V0_p N_I(x_p).  Nodes that no point reaches take the mean
/// of their neighbours, for two layers, so that the field goes on a little beyond the body; nodes
/// beyond are 0.  Throws std::invalid_argument if `values` is not one a point.
NodeField node_average(const io::Frame& frame, const std::vector<double>& values);

/// The same bilinear field on `times` as many cells a side.
NodeField refined(const NodeField& field, std::size_t times);

/// The field smoothed by the quadratic B-spline, on `times` (even) as many cells a side: no steps
/// in slope at cell sides, and never beyond the values of the nodes around.
NodeField refined_smooth(const NodeField& field, std::size_t times);

} // namespace scarp::render
