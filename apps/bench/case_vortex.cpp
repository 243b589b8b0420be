// Order of convergence on the generalised vortex (apps/bench/vortex.hpp), B-splines.
//
// The time step shrinks with the square of the cell size: points move with the velocity of the
// nodes at the step's beginning, which on a curved path is of first order in time.
//
// The turn was not chosen blindly: with 1 rad (shear up to 3.9) 8 to 32 cells are too coarse and
// give an order of 1.70, which the full run reports beside this one.
#include "apps/bench/cases.hpp"
#include "apps/bench/charts.hpp"
#include "apps/bench/vortex.hpp"

#include <fmt/format.h>

namespace scarp::bench {

namespace {

constexpr int coarsest = 8; // cells a metre, half a ring

struct Orders {
  Convergence displacement;
  Convergence stress;
};

Orders refine(double amplitude, const std::vector<int>& levels, VelocityTransfer transfer,
              const std::string& name) {
  Discretisation how;
  how.method.shape = ShapeFunctions::bspline;
  how.method.transfer = transfer;
  Orders orders = {{name + "displacement", {}, {}}, {name + "shear stress", {}, {}}};
  for (const int cells : levels) {
    how.cfl = 0.3 * coarsest / cells;
    const VortexRun run = run_vortex({amplitude}, cells, how);
    orders.displacement.cell_size.push_back(1.0 / cells);
    orders.displacement.error.push_back(run.error);
    orders.stress.cell_size.push_back(1.0 / cells);
    orders.stress.error.push_back(run.stress_error);
  }
  return orders;
}

} // namespace

CaseReport vortex_case(Effort effort) {
  const bool full = effort == Effort::full;
  const std::vector<int> levels =
      full ? std::vector{coarsest, 16, 32, 64} : std::vector{coarsest, 16, 32};
  constexpr double amplitude = 0.5; // rad
  const Orders flip = refine(amplitude, levels, VelocityTransfer::flip, "");
  CaseReport report;
  report.checks = {
      {"displacement_order", flip.displacement.order(), 2.0, 1.8, Bound::at_least, "-",
       "manufactured solution for the Jaumann law, derived in apps/bench/vortex.hpp; quadratic "
       "B-splines and leapfrog are of second order",
       fmt::format("L2 of the displacement at a turn of {} rad (shear up to {:.1f}); step ~ cell "
                   "size squared",
                   amplitude, 3.9 * amplitude)}};
  report.convergence = {flip.displacement, flip.stress};
  if (full) { // what larger turns and another transfer give
    const Orders wide =
        refine(2.0 * amplitude, {coarsest, 16, 32}, VelocityTransfer::flip, "1 rad: ");
    const Orders affine = refine(amplitude, {coarsest, 16, 32}, VelocityTransfer::aflip, "AFLIP: ");
    report.convergence.push_back(wide.displacement);
    report.convergence.push_back(affine.displacement);
  }
  report.figure = {
      convergence_chart(report.convergence, {2.0}, "cell size (m)", "relative error in L2")};
  report.caption = "Generalised vortex: error at the largest turn over the cell size.";
  return report;
}

} // namespace scarp::bench
