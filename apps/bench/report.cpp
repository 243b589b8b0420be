#include "apps/bench/report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace scarp::bench {

bool Check::pass() const {
  switch (kind) {
  case Bound::relative:
    return std::abs(value - reference) <= bound * std::abs(reference);
  case Bound::absolute:
    return std::abs(value - reference) <= bound;
  case Bound::at_least:
    return value >= bound;
  case Bound::at_most:
    return value <= bound;
  }
  return false;
}

std::string Check::demand() const {
  switch (kind) {
  case Bound::relative:
    return fmt::format("{:.5g} ± {:.3g} %", reference, 100.0 * bound);
  case Bound::absolute:
    return fmt::format("{:.5g} ± {:.2g}", reference, bound);
  case Bound::at_least:
    return fmt::format("≥ {:.5g}", bound);
  case Bound::at_most:
    return fmt::format("≤ {:.5g}", bound);
  }
  return "";
}

double Convergence::order() const {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  const auto n = static_cast<double>(error.size());
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double x = std::log(cell_size[i]);
    const double y = std::log(error[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

nlohmann::ordered_json to_json(const Check& check) {
  constexpr const char* kinds[] = {"relative", "absolute", "at_least", "at_most"};
  return {{"value", check.value},   {"reference", check.reference},
          {"bound", check.bound},   {"bound_kind", kinds[static_cast<int>(check.kind)]},
          {"pass", check.pass()},   {"unit", check.unit},
          {"source", check.source}, {"note", check.note}};
}

nlohmann::ordered_json to_json(const Convergence& convergence) {
  return {{"name", convergence.name},
          {"cell_size", convergence.cell_size},
          {"error", convergence.error},
          {"order", convergence.order()}};
}

} // namespace scarp::bench
