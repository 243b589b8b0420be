// The collapse of a pile of aluminium rods: run, measured against the experiment, and drawn.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scarp::apps {

struct Bui2008Options {
  std::filesystem::path out;
  double cell_size = 0.0025; ///< m; 0.001 is the paper's, with 80 000 points
  int threads = 0;           ///< 0: all there are
  std::vector<std::string> set;
};

/// Runs data/scenes/bui2008.toml, prints the table of values, experiment and errors, and writes the
/// series, summary.json, figures 2, 3 and 5 of Wu 2017 and the energy balance.
void reproduce_bui2008(const Bui2008Options& options);

} // namespace scarp::apps
