// One frame of a series as plain columns: what the writer takes and the reader gives back.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace scarp::io {

/// A field over the points: values[point * components + component].  Tensors have 6 components in
/// VTK's order xx yy zz xy yz xz.
struct Column {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

/// Points are in the order of their creation, the same in every frame of a series.
struct Frame {
  double time = 0.0;                       ///< s
  long step = 0;                           ///< time steps done
  int dimension = 2;                       ///< 2: plane strain (all y are 0), 3
  double cell_size = 0.0;                  ///< m
  std::array<double, 3> lower = {0, 0, 0}; ///< m, corner of the grid
  std::array<double, 3> upper = {0, 0, 0}; ///< m
  std::vector<double> position;            ///< m, x y z of each point, z up
  std::vector<Column> columns;

  std::size_t size() const { return position.size() / 3; }
  bool has(const std::string& name) const;
  /// Throws std::runtime_error that names the columns there are.
  const Column& column(const std::string& name) const;
};

} // namespace scarp::io
