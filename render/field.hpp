// Which column of a frame is drawn, its label, and the range of its colours.
#pragma once

#include "io/frame.hpp"

#include <span>
#include <string>
#include <vector>

namespace scarp::render {

/// A scalar of the points.  Component -1: the scalar itself or a vector's magnitude; 0...2, 0...5
/// or 0...8: one component of a vector, a symmetric tensor or a gradient.
struct Field {
  std::string name = "equivalent_plastic_strain";
  int component = -1;
  /// To draw it in, such as kPa of Pa or mm of m; empty: the SI unit of the column.
  std::string unit = {};

  bool operator==(const Field&) const = default;
};

/// Throws std::invalid_argument that lists those there are if the column has no such component.
void require_component(const io::Column& column, int component);

/// One value a point, in the field's unit.  Throws std::runtime_error if there is no such column,
/// std::invalid_argument if there is no such component or unit or a tensor is asked for its
/// magnitude.
std::vector<double> field_values(const io::Frame& frame, const Field& field);

/// "velocity magnitude", "vertical stress", "equivalent plastic strain"; underscores of unknown
/// names become blanks.
std::string field_label(const io::Frame& frame, const Field& field);
/// "m/s", "kPa"; "-" if the field has no dimension, empty if it is unknown.
std::string field_unit(const Field& field);
/// Whether the values are numbers of things, such as `region`, not quantities.
bool is_category(const Field& field);

/// The values of one frame or several: all of them, and all but the most extreme one per cent at
/// each end.
struct ValueSpread {
  double least = 0.0;
  double largest = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Not-a-number values do not count; without values all members are 0.
ValueSpread value_spread(const io::Frame& frame, const Field& field);
ValueSpread united(const ValueSpread& a, const ValueSpread& b);

/// Band b holds lower + b (upper - lower) / bands and more.  Values beyond an end take the last
/// band's colour; the bar then ends in an arrow.
struct ColourRange {
  double lower = 0.0;
  double upper = 1.0;
  int bands = 12;
  bool values_below = false;
  bool values_above = false;

  std::vector<double> edges() const; ///< bands + 1 values
  bool operator==(const ColourRange&) const = default;
};

/// Covers low...high of the spread with at most `most_bands` bands of a round width, from 0 if the
/// values come near it.
ColourRange round_range(const ValueSpread& spread, int most_bands);

/// One range for all frames of a series; categories get one band a number.  For a series too large
/// for memory unite the spreads frame by frame.  Throws as field_values().
ColourRange common_range(std::span<const io::Frame> frames, const Field& field,
                         int most_bands = 12);

} // namespace scarp::render
