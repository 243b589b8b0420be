// What a verification case says: numbers beside their references, measured orders, curves.
#pragma once

#include "render/line_chart.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace scarp::bench {

/// How a value has to lie: within `bound` of the reference as a part of it, or in the value's own
/// unit; or not below, not above the bound, whatever the reference.
enum class Bound { relative, absolute, at_least, at_most };

struct Check {
  std::string name; ///< unique among the checks of its case
  double value = 0.0;
  double reference = 0.0;
  double bound = 0.0;
  Bound kind = Bound::relative;
  std::string unit = "-";
  std::string source; ///< of the reference: a derivation or a citation
  std::string note = {};

  /// False for a value that is no number.
  bool pass() const;
  /// Such as "5.14 ± 5 %" or "<= 0.01".
  std::string demand() const;
};

/// Errors against cell sizes, both in the units that the case says.
struct Convergence {
  std::string name;
  std::vector<double> cell_size;
  std::vector<double> error;

  /// Slope of the least-squares line through log(error) over log(cell size).
  double order() const;
};

struct CaseReport {
  std::vector<Check> checks;
  std::vector<Convergence> convergence = {};
  std::vector<render::Chart> figure = {}; ///< panels; none: no figure
  std::string caption = {};
};

nlohmann::ordered_json to_json(const Check& check);
nlohmann::ordered_json to_json(const Convergence& convergence);

} // namespace scarp::bench
