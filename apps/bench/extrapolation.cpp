#include "apps/bench/extrapolation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace scarp::bench {

Extrapolation extrapolate(const std::vector<double>& cell_size, const std::vector<double>& answer) {
  constexpr double safety = 1.25; // of three grids (Roache)
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = answer.size();
  if (n < 3 || cell_size.size() != n)
    throw std::invalid_argument("extrapolation takes three cell sizes and answers");
  const double refinement = cell_size[n - 2] / cell_size[n - 1];
  if (!(refinement > 1.0) ||
      std::abs(cell_size[n - 3] / cell_size[n - 2] - refinement) > 1e-6 * refinement)
    throw std::invalid_argument("extrapolation takes cells that shrink by one factor");

  const double before = answer[n - 2] - answer[n - 3];
  const double last = answer[n - 1] - answer[n - 2];
  if (before * last < 0.0) return {Course::oscillates, nothing, nothing, nothing};
  if (!(std::abs(last) < std::abs(before))) return {Course::diverges, nothing, nothing, nothing};
  const double beyond = last / (before / last - 1.0);
  return {Course::converges, answer[n - 1] + beyond, std::log(before / last) / std::log(refinement),
          safety * std::abs(beyond)};
}

std::string to_text(const Extrapolation& extrapolation) {
  switch (extrapolation.course) {
  case Course::converges:
    return fmt::format("{:.4g} ± {:.2g} (order {:.2f})", extrapolation.value, extrapolation.bar,
                       extrapolation.order);
  case Course::oscillates:
    return "no value: differences change sign";
  case Course::diverges:
    break;
  }
  return "no value: differences do not shrink";
}

} // namespace scarp::bench
