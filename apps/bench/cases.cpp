#include "apps/bench/cases.hpp"

namespace scarp::bench {

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"bar", "Axial vibration of an elastic bar", bar_case},
  };
  return all;
}

} // namespace scarp::bench
