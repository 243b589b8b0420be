#include "apps/bench/flops.hpp"

#include "core/linear_shape.hpp"
#include "core/spline_shape.hpp"
#include "core/stress_pass.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace scarp::bench {

namespace {

/// A number that counts what is done with it and its like.
class Counted {
 public:
  Counted() = default;
  Counted(double value) : value_(value) {} // as a double converts to the solver's numbers

  static int& operations() {
    thread_local int count = 0;
    return count;
  }

  Counted& operator+=(const Counted& b) { return *this = *this + b; }
  Counted& operator-=(const Counted& b) { return *this = *this - b; }
  Counted& operator*=(const Counted& b) { return *this = *this * b; }

  friend Counted operator+(const Counted& a, const Counted& b) { return one(a.value_ + b.value_); }
  friend Counted operator-(const Counted& a, const Counted& b) { return one(a.value_ - b.value_); }
  friend Counted operator*(const Counted& a, const Counted& b) { return one(a.value_ * b.value_); }
  friend Counted operator/(const Counted& a, const Counted& b) { return one(a.value_ / b.value_); }
  friend Counted operator-(const Counted& a) { return {-a.value_}; }
  friend Counted sqrt(const Counted& a) { return one(std::sqrt(a.value_)); }
  friend auto operator<=>(const Counted& a, const Counted& b) { return a.value_ <=> b.value_; }
  friend bool operator==(const Counted& a, const Counted& b) { return a.value_ == b.value_; }

 private:
  static Counted one(double value) {
    ++operations();
    return {value};
  }

  double value_ = 0.0;
};

template <class Work> int count(Work&& work) {
  const int before = Counted::operations();
  work();
  return Counted::operations() - before;
}

template <int Dim> StencilCell<Dim> inner_cell() {
  Grid grid;
  grid.dimension = Dim;
  grid.cell_size = 1.0;
  grid.upper = {3.0, 3.0, 3.0};
  std::array<int, Dim> along;
  along.fill(1);
  return {GridIndex<Dim>(grid), along, 0.25};
}

template <int Dim> std::array<Counted, Dim> some_place() {
  std::array<Counted, Dim> xi;
  xi.fill(0.3);
  return xi;
}

template <int Dim, class Shape> int interpolation() {
  const auto w = Shape::along(some_place<Dim>(), inner_cell<Dim>()).w;
  return count([&] { interpolate(w, [](std::size_t) { return 1.0; }); });
}

/// A strain increment of a yielding point; all of the return is done.
template <int Dim> int law() {
  DruckerPrager parameters;
  parameters.friction_angle = 20.0;
  const ElasticModuli moduli = ElasticModuli::from(1e6, 0.3);
  const auto update = DruckerPragerUpdate::from(parameters, moduli);
  SymTensor<Dim, Counted> tau;
  tau.fill(-1.0);
  Mat<Dim, Counted> grad_v;
  for (auto& row : grad_v) row.fill(0.1);
  Counted gap = 0.1;
  // The rate of volume is not averaged: of what `dilation` adds, a product and a sum, nothing is
  // done.
  constexpr int of_dilation = 2;
  return count([&] {
           update_stress<Dim, Counted>(tau, gap, Counted(0.1), grad_v, Counted(0.0), 1e-3, moduli,
                                       update);
         }) -
         of_dilation;
}

struct AlongAxis {
  int functions;
  int derivatives;
};

constexpr AlongAxis stated(ShapeFunctions shape) {
  return shape == ShapeFunctions::linear ? AlongAxis{1, 0} : AlongAxis{7, 3};
}

template <int Dim, class Shape>
StepCost cost_of(AlongAxis axis, VelocityTransfer transfer, double points_of_cell, double number) {
  const bool affine = transfer != VelocityTransfer::flip,
             keeps = transfer != VelocityTransfer::apic;
  constexpr int d = Dim, w = Shape::width, n = Shape::nodes, s = d * (d + 1) / 2;
  constexpr int t = tensor_size<Dim>, d2 = d * d;
  const int place = 3 * d, functions = d * axis.functions, derivatives = d * axis.derivatives;
  const int I = interpolation<Dim, Shape>();
  constexpr int lines = n / w;
  constexpr int products = d == 3 ? 3 * lines : 0, value = lines + 2 * n;
  constexpr int forces = d * lines * (2 * d - 2) + 4 * d * n;
  // Instead of d values.
  constexpr int affine_to_nodes = d2 + 2 * w * d + 2 * d2 * lines + 4 * d * n - d * value;
  const int affine_of_point = 3 * w * d + d2 * I + 2 * d2;
  // v_p and, of affine transfers, C_p
  const int kept = (d + (affine ? d2 : 0)) * (I + 4);

  StepCost cost;
  const auto set = [&](Phase phase, double flops, double bytes) {
    cost.flops[static_cast<std::size_t>(phase)] = flops;
    cost.bytes[static_cast<std::size_t>(phase)] = bytes;
  };
  // A cell's sums, an entry in each of its tile's lines: m, m v and f.  A node's numbers: m,
  // inverse mass, force, v, dv.
  constexpr double index = 4.0; // B
  const double tile = (1 + 2 * d) * lines * number / points_of_cell;
  const double node = (2 + 3 * d) * number / points_of_cell;
  const double neighbours = lines * index / points_of_cell;
  const double moments = d * lines * number / points_of_cell;
  const double gradients = affine ? d2 * number : 0.0;

  set(Phase::sort, 2 * d, d * number);
  set(Phase::scatter,
      place + functions + derivatives + products + d + s + (2 + d) * value + forces +
          (2 + 2 * d) * lines * (w - 1) / points_of_cell + (affine ? affine_to_nodes : 0),
      (d + d + t + 2) * number + gradients + tile);
  set(Phase::nodes, ((1 + 2 * d) * lines + 2 + d + d + 4 * d + d) / points_of_cell,
      tile + 2 * neighbours + 3 * node + number / points_of_cell);
  set(Phase::gather,
      place + functions + products + d * I + (keeps ? kept : 0) + 4 * d + d + d * value +
          d * lines * (w - 1) / points_of_cell + (affine ? affine_of_point + affine_to_nodes : 0),
      (d + (keeps ? 2 : 1) * d + 1) * number + (keeps ? 2 : 1) * gradients + moments + node);
  set(Phase::remap, (d * lines + d) / points_of_cell, moments + neighbours + 2 * node);
  // At last the points move, and it is looked whether they leave.
  set(Phase::stress,
      place + functions + derivatives + d2 * I + I + 2 + law<Dim>() + d + 5 + 2 + d * I + 2 * d +
          2 * d,
      (2 * d + 2 * t + 2 * 4) * number + 1.0 + node);
  return cost;
}

template <int Dim>
StepCost cost_of(ShapeFunctions shape, VelocityTransfer transfer, double points_of_cell,
                 double number) {
  if (shape == ShapeFunctions::linear)
    return cost_of<Dim, LinearShape<Dim>>(stated(shape), transfer, points_of_cell, number);
  if (shape == ShapeFunctions::bspline)
    return cost_of<Dim, SplineShape<Dim>>(stated(shape), transfer, points_of_cell, number);
  throw std::invalid_argument("step_cost: linear functions or B-splines");
}

template <class Shape> int counted_along() {
  return count([] { Shape::along(some_place<2>(), inner_cell<2>()); }) / 2;
}

} // namespace

double StepCost::all_flops() const { return std::accumulate(flops.begin(), flops.end(), 0.0); }

double StepCost::all_bytes() const { return std::accumulate(bytes.begin(), bytes.end(), 0.0); }

StepCost step_cost(int dimension, ShapeFunctions shape, VelocityTransfer transfer,
                   int points_per_cell, std::size_t number_size) {
  const double points_of_cell = std::pow(points_per_cell, dimension);
  const auto number = static_cast<double>(number_size);
  return dimension == 2 ? cost_of<2>(shape, transfer, points_of_cell, number)
                        : cost_of<3>(shape, transfer, points_of_cell, number);
}

AxisFlops axis_flops(ShapeFunctions shape) {
  const AlongAxis one = stated(shape);
  return {one.functions + one.derivatives, shape == ShapeFunctions::linear
                                               ? counted_along<LinearShape<2>>()
                                               : counted_along<SplineShape<2>>()};
}

} // namespace scarp::bench
