// `scarp bench accuracy`: every verification case and the work-precision runs, as JSON, pictures
// and a page.
#pragma once

#include "apps/bench/cases.hpp"
#include "apps/bench/work.hpp"

#include <filesystem>
#include <vector>

namespace scarp::bench {

struct AccuracyOptions {
  std::filesystem::path out; ///< a directory that exists
  bool quick = false;
  std::vector<std::string> only; ///< of names(); empty: all
};

/// One case that has run.
struct CaseResult {
  const Case* origin = nullptr;
  CaseReport report;
  std::string failure; ///< what the solver said, if it stopped
  double wall = 0.0;   ///< s

  bool passes() const;
};

/// Of all cases and work-precision scenes.
std::vector<std::string> names();

/// Says on stdout how each check did.  Whether all passed.  Throws std::runtime_error if a file
/// cannot be written.
bool run_accuracy(const AccuracyOptions& options);

/// Writes the figures and index.html.
void write_page(const AccuracyOptions& options, const std::vector<CaseResult>& cases,
                const std::vector<WorkResult>& work, double wall);

} // namespace scarp::bench
