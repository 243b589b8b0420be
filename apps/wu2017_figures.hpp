// The figures of Wu et al. 2017 from computed results.
#pragma once

#include "apps/wu2017_case.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace scarp::apps {

struct Figure {
  std::filesystem::path file;
  std::string caption;
};

/// Draws figures 6 to 12, the parity plots and the residuals as PNG files into a directory.  Throws
/// std::runtime_error if a run's series lacks a frame.
std::vector<Figure> draw_wu2017(const Wu2017& results, const std::filesystem::path& directory);

} // namespace scarp::apps
