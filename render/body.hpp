// What is measured on a plane-strain frame.  The definitions are complete, so another program can
// compute the same numbers from the same series.
#pragma once

#include "io/frame.hpp"
#include "io/table.hpp"
#include "render/node_field.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace scarp::render {

/// The body is where the volume fraction (see volume_fraction()) is at least one half.
struct BodyShape {
  NodeField fraction; ///< on the nodes of the frame's grid
  std::vector<Polyline>
      free_surface;     ///< m; the 0.5 contour, marching squares with linear crossings
  double run_out = 0.0; ///< m; largest x of the contour, or of the grid if the body reaches its
                        ///< end; the grid's lower x if there is no body

  /// m; the highest z at which the fraction, bilinear between the nodes, comes down through 0.5;
  /// the grid's upper z if the body fills it.  Empty where there is no body or no grid.
  std::optional<double> height_at(double x) const;
};

/// Throws std::invalid_argument if the frame is not plane strain, std::runtime_error if it has no
/// volumes.
BodyShape measure_body(const io::Frame& frame);

/// Model minus experiment over the rows of an experiment.
struct CurveError {
  double rms = 0.0; ///< m
  double max = 0.0; ///< m, largest absolute value
  std::size_t n = 0;
};

/// Differences of height at each x_m of the experiment (columns x_m, z_m in m).  Where the model
/// has no body its height is 0.
CurveError surface_error(const BodyShape& body, const io::Table& experiment);

/// The line between points that moved and points that did not, at their undeformed positions.
struct FailureLine {
  std::vector<double> x; ///< m, one a column of the undeformed lattice, ascending
  std::vector<double> z; ///< m

  /// Linear between the columns, constant beyond them.  NaN if there are no points.
  double z_at(double x_m) const;
  Polyline line() const;
};

/// Undeformed positions are `position` - `displacement`; points belong to one column of the
/// undeformed lattice if their x differ by less than a tenth of a cell.  Going up a column from its
/// bottom, z is where abs(displacement) first comes to `threshold` (m), linear between the points.
/// A column without moved points has its top there, one whose lowest point moved its bottom; both
/// lie half a point spacing of the column beyond its last points.
/// Throws std::invalid_argument if the frame is not plane strain, std::runtime_error if it has no
/// displacement.
FailureLine failure_line(const io::Frame& frame, double threshold = 1e-3);

/// Differences of z at each x_m of the experiment (columns x_m, z_m in m).
CurveError failure_error(const FailureLine& line, const io::Table& experiment);

/// Points that left the body, by index: those outside the grid, and those in cells that are more
/// than two cells (the larger of the differences in x, y, z) from every cell of the largest
/// connected set of occupied cells.  Cells are occupied if they hold a point and connected if they
/// share a corner.  Plane strain or 3-D.
std::vector<std::size_t> thrown_off(const io::Frame& frame);

/// max abs(volume / initial_volume - 1) over the points; empty without both columns.
std::optional<double> max_abs_volume_ratio_error(const io::Frame& frame);

} // namespace scarp::render
