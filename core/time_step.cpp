#include "core/time_step.hpp"

#include "core/gimp_shape.hpp"
#include "core/linear_shape.hpp"
#include "core/spline_shape.hpp"

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

} // namespace

Real critical_speed(const Scene& scene) {
  Real most = 0.0;
  for (const Material& material : scene.materials)
    most = std::max(most, scene.grid.dimension == 2 ? critical_speed_in<2>(scene, material)
                                                    : critical_speed_in<3>(scene, material));
  return most;
}

} // namespace scarp
