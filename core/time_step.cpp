#include "core/time_step.hpp"

#include "core/gimp_shape.hpp"
#include "core/linear_shape.hpp"
#include "core/spline_shape.hpp"

#include <array>
#include <string>
#include <vector>

namespace scarp {

namespace {

template <int Dim> Real critical_speed_in(const Scene& scene, const Material& material) {
  const auto moduli = ElasticModuli::from(material.youngs_modulus, material.poissons_ratio);
  const Real half_point = 0.5 / scene.grid.points_per_cell;
  switch (scene.method.shape) {
  case ShapeFunctions::gimp:
    return critical_speed<Dim, GimpShape<Dim>>(moduli, material.density, half_point);
  case ShapeFunctions::bspline:
    return critical_speed<Dim, SplineShape<Dim>>(moduli, material.density, half_point);
  case ShapeFunctions::linear:
    break;
  }
  return critical_speed<Dim, LinearShape<Dim>>(moduli, material.density, half_point);
}

/// None if no material has the name.
const Material* material_in(const Scene& scene, const Region& region, const Stage& stage) {
  const auto material =
      std::ranges::find(scene.materials, stage.material_of(region), &Material::name);
  return material == scene.materials.end() ? nullptr : &*material;
}

std::array<double, 3> extents(const Region& region) {
  const auto extent = [](const auto& values, const auto& at) {
    const auto [least, most] = std::ranges::minmax(values, {}, at);
    return at(most) - at(least);
  };
  const auto x = [](const auto& corner) { return corner[0]; };
  const auto z = [](const auto& corner) { return corner[1]; };
  return {extent(region.polygon, x), region.depth[1] - region.depth[0], extent(region.polygon, z)};
}

} // namespace

Real crushing(const Scene& scene, const Region& region, const Stage& stage) {
  const Material* material = material_in(scene, region, stage);
  if (material == nullptr) return 1.0;
  const double multiple = stage.largest_gravity(region);
  const std::array<double, 3> length = extents(region);
  double weight = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    if (i != 1 || scene.grid.dimension == 3)
      weight += material->density * multiple * std::abs(scene.gravity[i]) * length[i];
  const auto moduli = ElasticModuli::from(material->youngs_modulus, material->poissons_ratio);
  return std::sqrt(std::max(1.0, weight / moduli.p_wave()));
}

Real critical_speed(const Scene& scene, const Stage& stage) {
  Real most = 0.0, faster = 1.0;
  for (const Region& region : scene.regions) {
    if (const Material* material = material_in(scene, region, stage))
      most = std::max(most, scene.grid.dimension == 2 ? critical_speed_in<2>(scene, *material)
                                                      : critical_speed_in<3>(scene, *material));
    faster = std::max(faster, crushing(scene, region, stage));
  }
  return most * faster;
}

} // namespace scarp
