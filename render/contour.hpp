// Lines and bands of equal value of a node field.
#pragma once

#include "render/node_field.hpp"

#include <functional>
#include <vector>

namespace scarp::render {

/// The lines where the field is `level` (marching squares; a saddle is cut by the cell's mean).
/// Higher values lie to the left of a line; a closed line ends where it begins, an open one ends at
/// the sides of the grid.
std::vector<Polyline> contour_lines(const NodeField& field, double level);

/// Splits the body, where `body` is 0.5 and more, into bands of `field`: band b holds
/// edges[b] <= field < edges[b + 1], the first and the last band also all values beyond.  Each
/// cell is four triangles about its centre, linear in each.  `emit` gets convex polygons in metres
/// that tile the body.  The two fields have the same nodes.
void filled_bands(const NodeField& body, const NodeField& field, const std::vector<double>& edges,
                  const std::function<void(const Polyline& polygon, std::size_t band)>& emit);

} // namespace scarp::render
