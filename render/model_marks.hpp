// Supports, dimensions and labels of a model figure.  Internal to render.
#pragma once

#include "render/model_figure.hpp"
#include "render/obstacles.hpp"
#include "render/plot_area.hpp"

#include <optional>
#include <string>

namespace scarp::render {

/// A side of the body on the grid's side, px, with `outward` a unit vector.
struct Side {
  Point begin;
  Point end;
  Point outward;

  double length() const;
  Point at(double along, double out) const;
};

void draw_support(Drawing& drawing, const Side& side, Support support, double font_size);

/// px
struct DimensionLine {
  Point begin; ///< the arrow's tips
  Point end;
  Point from; ///< the measured points; where they are not the tips, lines lead to them
  Point to;
  Words words;
};

/// The label stands on the side of `outward`, a unit vector across the arrow.
DimensionLine dimension_line(Point begin, Point end, Point outward, const std::string& label,
                             double font_size);
DimensionLine dimension_line(const DimensionMark& mark, const PlotArea& area, double font_size);
/// What the arrow and its label cover.
Box bounds(const DimensionLine& line);
void draw_dimension(Drawing& drawing, const DimensionLine& line, double font_size);

/// "0.2 m", with the digits the number has to a thousandth of itself.
std::string metres(double length);

/// The words beside a mark at `at`, px, where they meet nothing, as near as can be; up to the right
/// if there is no such place.
Words beside(Point at, Words words, const Obstacles& obstacles, double font_size);

/// The words within a polygon, px, as near to its middle as can be without meeting anything;
/// nothing if it is too small.
std::optional<Words> within(const Polyline& polygon, Words words, const Obstacles& obstacles,
                            double font_size);

} // namespace scarp::render
