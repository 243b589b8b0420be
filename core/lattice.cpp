#include "core/lattice.hpp"

#include "core/error.hpp"
#include "core/grid_index.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace scarp {

PolygonMeasure measure(const std::vector<Point2>& polygon) {
  if (polygon.size() < 3) return {0.0, {0.0, 0.0}};
  // Relative to the first vertex, so that a small piece far from the origin keeps its digits.
  const Point2 o = polygon.front();
  double area2 = 0.0;
  Point2 moment = {0.0, 0.0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point2 a = {polygon[i][0] - o[0], polygon[i][1] - o[1]};
    const Point2 b = {polygon[i + 1][0] - o[0], polygon[i + 1][1] - o[1]};
    const double cross = a[0] * b[1] - a[1] * b[0];
    area2 += cross;
    for (std::size_t k = 0; k < 2; ++k) moment[k] += cross * (a[k] + b[k]);
  }
  if (area2 == 0.0) return {0.0, o};
  return {0.5 * area2, {o[0] + moment[0] / (3.0 * area2), o[1] + moment[1] / (3.0 * area2)}};
}

std::vector<Point2> clip(const std::vector<Point2>& polygon, Point2 lower, Point2 upper) {
  std::vector<Point2> part = polygon;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const double bound = sign > 0.0 ? lower[axis] : upper[axis];
      const auto depth = [&](const Point2& q) { return sign * (q[axis] - bound); };
      std::vector<Point2> next;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Point2& a = part[i];
        const Point2& b = part[(i + 1) % part.size()];
        const double da = depth(a);
        const double db = depth(b);
        if (da >= 0.0) next.push_back(a);
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
          const double t = da / (da - db);
          Point2 cut = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
          cut[axis] = bound;
          next.push_back(cut);
        }
      }
      part = std::move(next);
    }
  }
  return part;
}

namespace {

/// Pieces smaller than this part of a lattice square are rounding, not material.
constexpr double sliver = 1e-9;

struct Piece {
  double area; ///< m2
  Point2 centroid;
};

template <int Dim>
void add_point(Particles<Dim>& points, const Scene& scene, std::size_t region, std::size_t material,
               const std::array<double, 3>& x, double volume) {
  for (int a = 0; a < Dim; ++a) {
    const auto i = static_cast<std::size_t>(a);
    points.x[i].push_back(x[scene_axis<Dim>(a)]);
    points.v[i].push_back(scene.regions[region].velocity[scene_axis<Dim>(a)]);
  }
  for (Column& column : points.tau) column.push_back(0.0);
  if (points.density == 0.0) points.m.push_back(volume * scene.materials[material].density);
  points.V0.push_back(volume);
  points.J.push_back(1.0);
  points.gap.push_back(0.0);
  points.plastic_strain.push_back(0.0);
  points.dissipation.push_back(0.0);
  points.id.push_back(static_cast<std::uint32_t>(points.id.size()));
  points.material.push_back(static_cast<std::uint8_t>(material));
  points.region.push_back(static_cast<std::uint8_t>(region));
}

} // namespace

std::size_t material_index(const Scene& scene, const Region& region, const std::string& material) {
  const auto found = std::ranges::find(scene.materials, material, &Material::name);
  if (found == scene.materials.end())
    throw SetupError("region '" + region.name + "': no material '" + material + "'");
  return static_cast<std::size_t>(found - scene.materials.begin());
}

namespace {

/// kg/m3, of all regions; or 0 if they differ.
double common_density(const Scene& scene) {
  double common = 0.0;
  for (const Region& region : scene.regions) {
    const double density = scene.materials[material_index(scene, region, region.material)].density;
    if (common != 0.0 && common != density) return 0.0;
    common = density;
  }
  return common;
}

} // namespace

template <int Dim> Particles<Dim> fill_regions(const Scene& scene) {
  const Grid& grid = scene.grid;
  const double a = grid.cell_size / grid.points_per_cell; // side of a lattice square
  const auto lattice_index = [&](double x, std::size_t axis, bool up) {
    const double i = (x - grid.lower[axis]) / a;
    const double nearest = std::round(i);
    if (std::abs(i - nearest) < 1e-9 * std::max(1.0, std::abs(i))) return std::lround(nearest);
    return std::lround(up ? std::ceil(i) : std::floor(i));
  };
  if (scene.regions.size() > 255 || scene.materials.size() > 255)
    throw SetupError("at most 255 regions and 255 materials");

  Particles<Dim> points;
  points.density = common_density(scene);
  std::map<std::array<long, 3>, std::pair<double, std::size_t>>
      filled; // part taken, by which region
  const bool may_overlap = scene.regions.size() > 1;

  for (std::size_t r = 0; r < scene.regions.size(); ++r) {
    const Region& region = scene.regions[r];
    const std::size_t material = material_index(scene, region, region.material);
    const std::size_t before = points.rows();
    std::array<double, 3> lower = {1e300, region.depth[0], 1e300};
    std::array<double, 3> upper = {-1e300, region.depth[1], -1e300};
    for (const Point2& q : region.polygon) {
      lower = {std::min(lower[0], q[0]), lower[1], std::min(lower[2], q[1])};
      upper = {std::max(upper[0], q[0]), upper[1], std::max(upper[2], q[1])};
    }
    for (int axis = 0; axis < Dim; ++axis) {
      const std::size_t i = scene_axis<Dim>(axis);
      const double slack = 1e-9 * grid.cell_size;
      if (lower[i] < grid.lower[i] - slack || upper[i] > grid.upper[i] + slack)
        throw SetupError("region '" + region.name + "' reaches outside the grid");
    }

    const long y_begin = Dim == 3 ? lattice_index(lower[1], 1, false) : 0;
    const long y_end = Dim == 3 ? lattice_index(upper[1], 1, true) : 1;
    for (long k = lattice_index(lower[2], 2, false); k < lattice_index(upper[2], 2, true); ++k) {
      for (long j = y_begin; j < y_end; ++j) {
        double y = 0.0;
        double thickness = 1.0; // plane strain: per metre of depth
        if constexpr (Dim == 3) {
          const double from = std::max(lower[1], grid.lower[1] + static_cast<double>(j) * a);
          const double to = std::min(upper[1], grid.lower[1] + static_cast<double>(j + 1) * a);
          y = 0.5 * (from + to);
          thickness = to - from;
          if (thickness < sliver * a) continue;
        }
        for (long i = lattice_index(lower[0], 0, false); i < lattice_index(upper[0], 0, true);
             ++i) {
          const Point2 from = {grid.lower[0] + static_cast<double>(i) * a,
                               grid.lower[2] + static_cast<double>(k) * a};
          const Point2 to = {grid.lower[0] + static_cast<double>(i + 1) * a,
                             grid.lower[2] + static_cast<double>(k + 1) * a};
          const PolygonMeasure part = measure(clip(region.polygon, from, to));
          Piece piece = {std::abs(part.area), part.centroid};
          if (piece.area < sliver * a * a) continue;
          if (piece.area > (1.0 - sliver) * a * a)
            piece = {a * a, {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])}};
          if (may_overlap) {
            auto& [taken, by] = filled.try_emplace({i, j, k}, 0.0, r).first->second;
            const double share = piece.area * thickness / (Dim == 3 ? a * a * a : a * a);
            if (taken + share > 1.0 + 1e-6)
              throw SetupError("regions '" + scene.regions[by].name + "' and '" + region.name +
                               "' overlap at x = " + std::to_string(piece.centroid[0]) +
                               ", z = " + std::to_string(piece.centroid[1]));
            taken += share;
            by = r;
          }
          add_point(points, scene, r, material, {piece.centroid[0], y, piece.centroid[1]},
                    piece.area * thickness);
        }
      }
    }
    if (points.rows() == before) throw SetupError("region '" + region.name + "' holds no point");
  }
  if (points.rows() == 0) throw SetupError("the scene has no region, so no material point");
  return points;
}

template Particles<2> fill_regions<2>(const Scene&);
template Particles<3> fill_regions<3>(const Scene&);

} // namespace scarp
