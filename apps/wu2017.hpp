// scarp reproduce wu2017: the surcharge-induced landslide of Wu et al. 2017.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scarp::apps {

struct Wu2017Options {
  std::filesystem::path out;
  std::vector<std::string> set; ///< key=value for the scenes of all runs
  int jobs = 0;                 ///< runs side by side; 0: as many as there are processors
};

/// Runs the base case and the study of table 1 (what is missing of it), draws figures 6 to 12 and
/// two more, fits and regresses, prints the tables, and writes OUT/index.html, OUT/results.csv and
/// OUT/summary.json.  Throws what the parts throw, and std::runtime_error at the end if a scenario
/// failed.
void reproduce_wu2017(const Wu2017Options& options);

} // namespace scarp::apps
