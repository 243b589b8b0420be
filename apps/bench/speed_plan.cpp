#include "apps/bench/speed.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace scarp::bench {

namespace {

Method method_with(ShapeFunctions shape, VelocityTransfer transfer,
                   Precision precision = Precision::double_precision) {
  Method method;
  method.precision = precision;
  method.shape = shape;
  method.transfer = transfer;
  method.flip = 0.999; // as the scenes of Bui 2008 and Wu 2017
  return method;
}

std::vector<SpeedMethod> speed_methods() {
  using enum ShapeFunctions;
  using enum VelocityTransfer;
  return {
      {.method = method_with(linear, flip)},
      {.method = method_with(linear, flip, Precision::single)},
      {.method = method_with(bspline, flip)},
      {.method = method_with(bspline, flip, Precision::single), .most_points = {2e6, 2e6}},
      {.method = method_with(bspline, apic), .most_points = {2e5, 2e5}},
      {.method = method_with(bspline, aflip), .most_points = {2e6, 2e6}}, // the default
      {.method = method_with(bspline, aflip, Precision::single), .most_points = {2e5, 2e5}},
  };
}

/// Steps that take tens of milliseconds, and so few in all that the front stays far from the end of
/// the grid.
SpeedSize full_size(int dimension, double points) {
  const CollapseSize size = collapse_of(dimension, points);
  if (points < 5e4) return {size, 20, dimension == 2 ? 100 : 24, 7}; // 3-D: large cells and steps
  if (points < 5e5) return {size, 30, 24, 7};
  if (points < 5e6) return {size, 20, 16, 5};
  return {size, 16, 12, 3};
}

/// The row of a method whose size is nearest to `points`, within a factor of three; else null.
const SpeedRow* find(const std::vector<SpeedRow>& rows, int dimension, const std::string& name,
                     const std::string& precision, int threads, double points) {
  constexpr double same_size = 3.0;
  const SpeedRow* best = nullptr;
  double nearest = std::log(same_size);
  for (const SpeedRow& row : rows) {
    if (row.dimension != dimension || row.threads != threads || row.how.name() != name ||
        row.how.precision() != precision)
      continue;
    const double distance = std::abs(std::log(static_cast<double>(row.points) / points));
    if (distance < nearest) best = &row, nearest = distance;
  }
  return best;
}

} // namespace

std::string SpeedMethod::precision() const {
  return method.precision == Precision::single ? "single" : "double";
}

std::size_t SpeedMethod::number_size() const {
  return method.precision == Precision::single ? sizeof(float) : sizeof(double);
}

std::string SpeedMethod::shape() const {
  return method.shape == ShapeFunctions::linear ? "linear"
         : method.shape == ShapeFunctions::gimp ? "gimp"
                                                : "bspline";
}

std::string SpeedMethod::transfer() const {
  return method.transfer == VelocityTransfer::flip   ? "flip"
         : method.transfer == VelocityTransfer::apic ? "apic"
                                                     : "aflip";
}

std::string SpeedMethod::name() const {
  return shape() + (method.transfer == VelocityTransfer::flip ? "" : " " + transfer());
}

SpeedPlan speed_plan(Effort effort) {
  SpeedPlan plan;
  plan.methods = speed_methods();
  plan.threads = {1};
  if (omp_get_num_procs() > 1) plan.threads.push_back(2);
  plan.largest_frame = 2e6;
  plan.rough_roofline = effort == Effort::quick;
  if (effort == Effort::quick) {
    plan.sizes = {{collapse_of(2, 1e5), 10, 12, 5}, {collapse_of(3, 1e5), 6, 6, 5}};
    return plan;
  }
  for (const double points : {1e4, 1e5, 1e6, 1e7}) plan.sizes.push_back(full_size(2, points));
  for (const double points : {1e4, 1e5, 1e6}) plan.sizes.push_back(full_size(3, points));
  return plan;
}

std::string SpeedRatio::verdict() const {
  if (!bound) return "-";
  return Check{name, value, *bound, *bound, kind, unit, ""}.pass() ? "pass" : "MISSED";
}

std::vector<SpeedRatio> speed_ratios(const std::vector<SpeedRow>& rows) {
  constexpr double usual = 1e5, large = 1e7; // points
  const auto row = [&](int dimension, const char* name, int threads, double points) {
    return find(rows, dimension, name, "double", threads, points);
  };
  const auto usual_row = [&](int dimension, const char* name, int threads) {
    return row(dimension, name, threads, usual);
  };
  const auto single_row = [&](int dimension, const char* name) {
    return find(rows, dimension, name, "single", 1, usual);
  };
  std::vector<SpeedRatio> ratios;
  const auto add = [&](const std::string& name, const SpeedRow* a, const SpeedRow* b, auto&& value,
                       const std::string& unit, std::optional<double> bound = {},
                       Bound kind = Bound::at_most) {
    if (!a || !b) return;
    SpeedRow a_alone = *a, b_alone = *b;
    a_alone.rate = a->alone;
    b_alone.rate = b->alone;
    ratios.push_back({name, value(*a, *b), value(a_alone, b_alone), unit, bound, kind});
  };
  const auto speed = [](const SpeedRow& a, const SpeedRow&) { return a.rate / 1e6; };
  const auto memory = [](const SpeedRow& a, const SpeedRow&) { return a.memory; };
  const auto faster = [](const SpeedRow& a, const SpeedRow& b) { return a.rate / b.rate; };
  const auto dearer = [](const SpeedRow& a, const SpeedRow& b) { return b.rate / a.rate; };

  const SpeedRow* flat = usual_row(2, "linear", 1);
  const SpeedRow* solid = usual_row(3, "linear", 1);
  const std::string millions = "million point-steps/s";
  add("plane strain, linear, 1 thread", flat, flat, speed, millions, 60.0, Bound::at_least);
  add("3-D, linear, 1 thread", solid, solid, speed, millions, 12.0, Bound::at_least);
  add("plane strain: cost of B-splines over linear", usual_row(2, "bspline", 1), flat, dearer, "-",
      2.5); // at least 0.4 of the speed
  add("3-D: cost of B-splines over linear", usual_row(3, "bspline", 1), solid, dearer, "-");
  add("plane strain: cost of AFLIP over FLIP, B-splines", usual_row(2, "bspline aflip", 1),
      usual_row(2, "bspline", 1), dearer, "-");
  add("3-D: cost of AFLIP over FLIP, B-splines", usual_row(3, "bspline aflip", 1),
      usual_row(3, "bspline", 1), dearer, "-");
  add("cost of 3-D over plane strain, linear", solid, flat, dearer, "-");
  add("plane strain, linear: 2 threads over 1", usual_row(2, "linear", 2), flat, faster, "-", 1.85,
      Bound::at_least);
  add("plane strain, linear, 10⁶ points: 2 threads over 1", row(2, "linear", 2, 1e6),
      row(2, "linear", 1, 1e6), faster, "-");
  add("3-D, linear: 2 threads over 1", usual_row(3, "linear", 2), solid, faster, "-");
  add("plane strain, linear, 1 thread: cost at 10⁷ over 10⁵ points", row(2, "linear", 1, large),
      row(2, "linear", 1, usual), dearer, "-", 1.3);
  for (const auto& [dimension, where] : {std::pair{2, "plane strain"}, std::pair{3, "3-D"}})
    for (const char* name : {"linear", "bspline"})
      add(std::string(where) + ", " + name + ": single over double", single_row(dimension, name),
          usual_row(dimension, name, 1), faster, "-",
          dimension == 2 && name == std::string("linear") ? std::optional(1.7) : std::nullopt,
          Bound::at_least);
  add("plane strain, linear: memory", flat, flat, memory, "B a point", 200.0);
  add("3-D, linear: memory", solid, solid, memory, "B a point", 320.0);
  return ratios;
}

} // namespace scarp::bench
