#include "apps/bench/work.hpp"

#include <fmt/format.h>

namespace scarp::bench {

namespace {

using enum ShapeFunctions;
using enum VelocityTransfer;

/// MUSL, as in the presets, with the method's usual step.
Discretisation method(ShapeFunctions shape, VelocityTransfer transfer = flip,
                      VolumeRate rate = VolumeRate::point) {
  Discretisation how;
  how.method.shape = shape;
  how.method.transfer = transfer;
  how.method.volume_rate = rate;
  how.cfl = usual_cfl(how.method);
  return how;
}

Discretisation in_single(Discretisation how) {
  how.method.precision = Precision::single;
  return how;
}

Discretisation with_points(Discretisation how, int points_per_cell) {
  how.points_per_cell = points_per_cell;
  return how;
}

Discretisation with_cfl(Discretisation how, double cfl) {
  how.cfl = cfl;
  return how;
}

} // namespace

std::vector<WorkPlan> every_method(Effort effort, const std::vector<int>& levels) {
  std::vector<WorkPlan> all;
  const auto add = [&](const std::string& name, const Discretisation& how) {
    all.push_back({name, how, levels});
  };
  add("linear", method(linear));
  add("linear, cell averages", method(linear, flip, VolumeRate::cell_average));
  add("GIMP", method(gimp));
  add("B-spline", method(bspline));
  add("B-spline, cell averages", method(bspline, flip, VolumeRate::cell_average));
  add("B-spline, APIC", method(bspline, apic));
  add("B-spline, AFLIP", method(bspline, aflip));
  add("linear, single precision", in_single(method(linear)));
  if (effort == Effort::quick) return all;
  add("B-spline, single precision", in_single(method(bspline)));
  add("B-spline, APIC, single precision", in_single(method(bspline, apic)));
  add("GIMP, APIC", method(gimp, apic));
  for (const int points : {3, 4}) {
    add(fmt::format("linear, {}² points", points), with_points(method(linear), points));
    add(fmt::format("B-spline, {}² points", points), with_points(method(bspline), points));
  }
  for (const double cfl : {0.1, 0.6})
    add(fmt::format("B-spline, CFL {}", cfl), with_cfl(method(bspline), cfl));
  return all;
}

std::vector<WorkPlan> landslide_methods(Effort effort, const std::vector<int>& levels,
                                        std::optional<int> finest) {
  std::vector<int> of_presets = levels;
  if (finest) of_presets.push_back(*finest);
  std::vector<WorkPlan> all = {
      {"linear", method(linear), of_presets},
      {"linear, cell averages", method(linear, flip, VolumeRate::cell_average), levels},
      {"B-spline", method(bspline), levels},
      {"B-spline, APIC", method(bspline, apic), levels},
      {"B-spline, AFLIP", method(bspline, aflip), of_presets}};
  if (effort == Effort::quick) return all;
  all.push_back({"B-spline, AFLIP, single precision", in_single(method(bspline, aflip)), levels});
  all.push_back({"linear, CFL 0.7", with_cfl(method(linear), 0.7), levels});
  all.push_back({"B-spline, AFLIP, CFL 0.3", with_cfl(method(bspline, aflip), 0.3), levels});
  return all;
}

} // namespace scarp::bench
