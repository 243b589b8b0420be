// Regions filled with material points on a lattice.
#pragma once

#include "core/particles.hpp"
#include "core/scene.hpp"

#include <array>
#include <vector>

namespace scarp {

using Point2 = std::array<double, 2>;

/// Area (positive for anticlockwise) and centroid of a simple polygon.
struct PolygonMeasure {
  double area;
  Point2 centroid;
};
PolygonMeasure measure(const std::vector<Point2>& polygon);

/// The part of a polygon inside the rectangle [lower, upper] (Sutherland & Hodgman 1974).  Where
/// the part is in pieces they hang together by edges of no area.
std::vector<Point2> clip(const std::vector<Point2>& polygon, Point2 lower, Point2 upper);

/// Material points of all regions, at rest in their regions' velocity, free of stress.
///
/// The lattice divides every cell into points_per_cell^Dim squares (cubes).  A whole square gives a
/// point at its centre; a square cut by the region's boundary gives one at the cut piece's centroid
/// with the cut piece's volume.  Order: regions as listed, then x fastest.
/// Throws SetupError where regions overlap, and where one is empty or reaches outside the grid.
template <int Dim> Particles<Dim> fill_regions(const Scene& scene);

/// Place in Scene::materials of a region's material.  Throws SetupError if it is not there.
std::size_t material_index(const Scene& scene, const Region& region, const std::string& material);

} // namespace scarp
