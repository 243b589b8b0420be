#include "core/scene.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {

DruckerPrager DruckerPrager::at_residual() const {
  DruckerPrager last = *this;
  const auto put = [](double later, double& value) {
    if (!std::isinf(later)) value = later;
  };
  put(residual.cohesion, last.cohesion);
  put(residual.friction_angle, last.friction_angle);
  put(residual.dilation_angle, last.dilation_angle);
  return last;
}

double Ramp::at(double time) const {
  const auto after = std::ranges::find_if(points, [&](const auto& p) { return p[0] > time; });
  if (after == points.begin()) return points.front()[1];
  if (after == points.end()) return points.back()[1];
  const auto& [t0, f0] = *(after - 1);
  const auto& [t1, f1] = *after;
  return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
}

double Ramp::largest() const {
  double most = 0.0;
  for (const auto& point : points) most = std::max(most, std::abs(point[1]));
  return most;
}

const std::string& Stage::material_of(const Region& region) const {
  const auto changed = material.find(region.name);
  return changed == material.end() ? region.material : changed->second;
}

double Stage::largest_gravity(const Region& region) const {
  const auto own = body_force.find(region.name);
  return gravity.largest() * (own == body_force.end() ? 1.0 : own->second.largest());
}

Method method_of(Preset preset) {
  Method method;
  method.preset = preset;
  if (preset == Preset::accurate) {
    method.shape = ShapeFunctions::bspline;
    method.transfer = VelocityTransfer::aflip;
  }
  return method;
}

double usual_cfl(const Method& method) {
  return method.transfer == VelocityTransfer::flip ? 0.3 : 0.7;
}

std::vector<Stage> stages_of(const Scene& scene) {
  if (!scene.stages.empty()) return scene.stages;
  Stage only;
  only.duration = scene.timing.end_time;
  only.until_rest = scene.timing.rest_energy_fraction > 0.0;
  return {only};
}

double end_time(const Scene& scene) {
  double end = 0.0;
  for (const Stage& stage : stages_of(scene)) end += stage.duration;
  return end;
}

} // namespace scarp
