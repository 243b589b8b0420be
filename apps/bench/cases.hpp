// The verification cases.  One more is one file case_NAME.cpp, one declaration here, and one line
// in cases.cpp.
#pragma once

#include "apps/bench/report.hpp"

#include <string>
#include <vector>

namespace scarp::bench {

/// quick: fewer refinements and shorter runs, for the whole suite in two minutes on one core.
enum class Effort { quick, full };

/// Each throws what the solver throws.
CaseReport bar_case(Effort effort);
CaseReport block_case(Effort effort);
CaseReport column_case(Effort effort);
CaseReport conservation_case(Effort effort);
CaseReport footing_case(Effort effort);
CaseReport granular_column_case(Effort effort);
CaseReport grid_independence_case(Effort effort);
CaseReport rankine_case(Effort effort);
CaseReport rotation_case(Effort effort);
CaseReport safety_case(Effort effort);
CaseReport stress_paths_case(Effort effort);
CaseReport vortex_case(Effort effort);

struct Case {
  std::string name;  ///< for --only
  std::string title; ///< for the page
  CaseReport (*run)(Effort effort);
};

const std::vector<Case>& cases();

} // namespace scarp::bench
