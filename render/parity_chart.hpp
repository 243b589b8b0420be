// How well values agree: computed against reference values, and residuals of a fit.
#pragma once

#include "render/line_chart.hpp"

#include <optional>
#include <string>
#include <vector>

namespace scarp::render {

struct ParityStyle {
  std::string quantity = {}; ///< the title
  std::string unit = {};
  std::string reference = "reference";  ///< where the values along x come from
  std::string computed = "scarp";       ///< and those along y
  std::optional<double> tolerance = {}; ///< such as 0.05: dashed lines 5 % above and below equality
  std::vector<std::string> notes = {};  ///< such as "R² = 0.98"
};

/// Computed (y) over reference values (x) as dots, the line of equality, equal axes.  Values that
/// are not numbers are left out.  Draw it by draw_chart() or draw_chart_panels(), which throw if
/// the values differ in number.
Chart parity_chart(const std::vector<double>& reference, const std::vector<double>& computed,
                   const ParityStyle& style);

struct ResidualStyle {
  std::string quantity = {}; ///< the title
  std::string unit = {};
  std::vector<std::string> notes = {};
};

/// Residual (y) over fitted value (x) as dots, and the zero line in the middle of the axis.
Chart residual_chart(const std::vector<double>& fitted, const std::vector<double>& residual,
                     const ResidualStyle& style);

} // namespace scarp::render
