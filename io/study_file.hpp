// Study files: TOML in, the scenarios of a parameter study out.
// What may stand in one is declared in io/study_schema.cpp.
#pragma once

#include "core/analysis/measures.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace scarp::io {

/// One run of a study.
struct Scenario {
  std::string name;                   ///< unique, and that of its directory
  std::vector<double> inputs;         ///< a value for each parameter of the study, in its unit
  std::vector<std::string> overrides; ///< of the scene, "key=value" as read_scene takes them
};

struct Study {
  std::string title;
  std::filesystem::path scene;         ///< the file that the overrides apply to
  std::vector<std::string> parameters; ///< names, with their units
  std::vector<Scenario> scenarios;     ///< in the order of the file; not empty
  analysis::MeasureOptions measure;
};

/// Reads and checks a study and the scenes of all its scenarios.  Throws SceneError with every
/// problem found, as "file:line:column: key: what is wrong; what is allowed".
Study read_study(const std::filesystem::path& file);

/// The manual of study files: every section and option with unit, default, allowed values, meaning.
std::string study_reference_markdown();

} // namespace scarp::io
