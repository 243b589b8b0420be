// What a study comes to: its runs, what several of them begin with, and how both are known again.
#pragma once

#include "core/scene.hpp"
#include "io/study_file.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scarp::apps {

struct PlannedRun {
  std::string name;
  std::vector<std::string> overrides;
  Scene scene;
  std::string beginning; ///< name of the run up to its last stage; empty: there is none
};

struct StudyPlan {
  std::vector<PlannedRun> runs;            ///< in the study's order
  std::map<std::string, Scene> beginnings; ///< by name: those of two runs or more
};

/// Throws io::SceneError if a scene cannot be read any more.
StudyPlan plan_study(const io::Study& study);

/// Where a beginning is kept in a study's directory.
std::filesystem::path beginning_folder(const std::filesystem::path& directory,
                                       const std::string& beginning);

/// run.json of a folder whose run came to its end; none if there is no such run.
std::optional<nlohmann::ordered_json> finished_record(const std::filesystem::path& folder);

/// Whether the record is that of the planned scene, run as a whole or from its beginning on.
bool is_record_of(const nlohmann::ordered_json& record, const PlannedRun& run);

/// Whether the record is that of a run from its beginning on.
bool continues_beginning(const nlohmann::ordered_json& record, const PlannedRun& run);

} // namespace scarp::apps
