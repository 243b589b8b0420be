// What the finished runs of a study measure.
#pragma once

#include "core/analysis/measures.hpp"
#include "core/scene.hpp"
#include "io/study_file.hpp"
#include "io/table.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace scarp::apps {

/// What is measured on a run: its monitors, energies and front, out of a column of history.csv by
/// its name.
analysis::SlideRecord
slide_record(const Scene& scene,
             const std::function<std::vector<double>(const std::string&)>& column);

struct StudyResults {
  std::vector<std::string> scenarios; ///< that have finished, in the study's order
  /// A row for each of them: the inputs, then what was measured, with units in the names.  NaN is
  /// what a run does not have, such as a time of rest.
  io::Table table;
  std::vector<std::string> missing; ///< scenarios that have not finished, or with another scene
};

/// The names of the table's columns.  Throws UsageError if a parameter has the name of another one.
std::vector<std::string> result_columns(const io::Study& study, const Scene& scene);

/// Reads the runs in a study's directory.  Throws std::runtime_error if a finished one cannot be
/// read or measured.
StudyResults collect_results(const io::Study& study, const std::filesystem::path& directory);

/// As comma-separated values, the scenarios' names in a first column `scenario`; whole or not at
/// all.  Throws std::runtime_error.
void write_results(const std::filesystem::path& file, const StudyResults& results);

} // namespace scarp::apps
