// The collapse of a pile of aluminium rods: run, measured against the experiment, and drawn.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scarp::apps {

/// What the pile's scene is changed to, by name.
struct PileModel {
  std::string help;
  std::vector<std::string> set; ///< overrides of data/scenes/bui2008.toml
};
/// published: as in Wu 2017.  The others add what that leaves out, with values from elsewhere:
/// inertial: friction that grows with the rate of shear.  inertial_sliding: also a base that bears
/// what the rods' own friction does instead of holding them.  disks: friction that grows up to a
/// limit, 0.28 / (1 + 0.4/I), with which columns of disks collapse as in simulations grain by grain
/// (Lagree, Staron & Popinet 2011, doi 10.1017/jfm.2011.335).
const std::map<std::string, PileModel>& pile_models();

struct Bui2008Options {
  std::filesystem::path out;
  double cell_size = 0.0025;       ///< m; 0.001 is the paper's, with 80 000 points
  std::string model = "published"; ///< one of pile_models()
  int threads = 0;                 ///< 0: all there are
  std::vector<std::string> set;
};

/// Runs data/scenes/bui2008.toml, prints the table of values, experiment and errors, and writes the
/// series, summary.json, figures 2, 3 and 5 of Wu 2017 and the energy balance.
void reproduce_bui2008(const Bui2008Options& options);

} // namespace scarp::apps
