// How many floating-point operations and bytes a point-step of MUSL needs, derived from the passes.
//
// An addition, subtraction, multiplication, division and square root is one operation each;
// comparisons, min, max, abs, floor, conversions and integer arithmetic are none, and so is what
// does not depend on the point or node (it is worked out once).  What registers do for nothing
// (lanes without a point) does not count: the fraction of the peak is that of useful work.  d =
// Dim, w = nodes that a cell reaches along an axis, n = w^d, t = stress components, s = d (d + 1)
// / 2.
//
//   place in the cell              (x - lower) / h - corner                                 3 d
//   functions along the axes, W    linear 1 - xi: d;  B-spline 7 d      (tested by counting)
//   derivatives, D                 linear 0;  B-spline 5 d              (tested by counting)
//   interpolation of a number, I   axis after axis: (2 w - 1) (n - 1) / (w - 1)
//                                                       (counted: interpolate() with a scalar that
//                                                        counts)
//   sort       cell of a point                                                              2 d
//   a value to the nodes, A        with l = n / w lines of nodes: l + 2 n
//   scatter    place, W, D, in 3-D products for the lines 3 l, products m v d and V0 tau s; m, V0
//   and
//              m v: (2 + d) A; f: d l (2 d - 2) + 4 d n; cells' sums along x (2 + 2 d) l (w - 1) a
//              cell
//     affine   m C d^2, x_I - x_p 2 w d, and instead of A for m v: 2 d^2 l + 4 d n
//   nodes      of a node, and there are 1 / ppc^d of them a point inside a body; every node has n
//              cells around it: m, V0, m v, f from tiles (2 + 2 d) n, 1 / m and fraction 2, v d,
//              gravity d, v after the forces 4 d, dv d
//   gather     place, W, products, d interpolations (v), speeds squared 4 d
//     keeps    (FLIP, AFLIP) d interpolations (dv), v_p 4 d
//     remap    m v d, to the nodes d A, cells' sums d l (w - 1) a cell
//     affine   weights of C: x_I - x_p 2 w d, D_p 3 w d, 1 / D_p d, q w d; C d^2 interpolations,
//              twice as many and 4 d^2 if it keeps; its square 2 d^2; m C, products and to the
//              nodes as in scatter
//   remap      of a node: m v from tiles d n, v d
//   stress     place, W, D, grad v d^2 interpolations, fraction 1, room 2, the law with its strain
//              increment and rotation (counted: update_stress() with a scalar that counts), rate of
//              volume d, J 5, strain and dissipation 2; motion: d interpolations, dx d, x d, place
//              2 d
//
// Left out, as it is not needed without damping or friction: the work that both take.
#pragma once

#include "core/phases.hpp"
#include "core/scene.hpp"

#include <array>

namespace scarp::bench {

/// Of one point-step, by Phase.
struct StepCost {
  std::array<double, phase_count> flops = {};
  std::array<double, phase_count> bytes = {};

  double flops_of(Phase phase) const { return flops[static_cast<std::size_t>(phase)]; }
  double all_flops() const;
  double all_bytes() const;
};

/// Linear functions or B-splines, any transfer, MUSL, Drucker-Prager that remembers gaps.
/// Bytes: every column that a pass reads or writes counts once a pass with `number_size` bytes a
/// number, tiles and nodes by their number a point, as if no cache held anything from pass to pass;
/// empty rows, and points that change cell, are left out.  Throws
/// std::invalid_argument for GIMP.
StepCost step_cost(int dimension, ShapeFunctions shape, VelocityTransfer transfer,
                   int points_per_cell, std::size_t number_size);

/// What the derivation says of functions along one axis and what running the solver's own code with
/// a scalar that counts gives, for the tests.
struct AxisFlops {
  int stated;
  int counted;
};
AxisFlops axis_flops(ShapeFunctions shape);

} // namespace scarp::bench
