// Frequency and energy of the vibrating bar (apps/bench/bar.hpp) with the published scheme: linear
// functions, MUSL, FLIP.
#include "apps/bench/bar.hpp"
#include "apps/bench/cases.hpp"
#include "apps/bench/charts.hpp"

#include <cmath>

namespace scarp::bench {

CaseReport bar_case(Effort effort) {
  const std::vector<int> levels =
      effort == Effort::quick ? std::vector{8, 16, 32} : std::vector{8, 16, 32, 64};
  constexpr int periods = 10, many = 100;
  Convergence convergence{"frequency", {}, {}};
  double error_32 = 0.0;
  for (const int cells : levels) {
    const double error = vibrate_bar(cells, periods, {}).frequency_error;
    convergence.cell_size.push_back(1.0 / cells);
    convergence.error.push_back(std::abs(error));
    if (cells == 32) error_32 = error;
  }
  const double drift = vibrate_bar(32, many, {}).energy_drift;

  CaseReport report;
  const std::string mode = "lowest mode of a bar, f = c / 4L";
  report.checks = {{"frequency_error_32_cells", error_32, 0.0, 0.005, Bound::absolute, "-", mode,
                    "linear, MUSL, FLIP = 1, 2 points a cell along an axis"},
                   {"frequency_order", convergence.order(), 2.0, 1.8, Bound::at_least, "-",
                    "second order of linear elements and of symplectic Euler"},
                   {"energy_drift_100_periods", drift, 0.0, 0.01, Bound::absolute, "-",
                    "no dissipation: the mean energy of each period is the same",
                    "32 cells, FLIP = 1"}};
  report.figure = {convergence_chart({convergence}, {2.0}, "cell size / length", "error of f")};
  report.caption = "Axial vibration of a bar: error of the frequency over the cell size.";
  report.convergence = {std::move(convergence)};
  return report;
}

} // namespace scarp::bench
