#include "apps/study_plan.hpp"

#include "io/scene_beginning.hpp"
#include "io/scene_file.hpp"
#include "io/text.hpp"

#include <nlohmann/json.hpp>

namespace scarp::apps {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

StudyPlan plan_study(const io::Study& study) {
  StudyPlan plan;
  std::map<std::string, int> uses;
  for (const io::Scenario& scenario : study.scenarios) {
    PlannedRun run{.name = scenario.name,
                   .overrides = scenario.overrides,
                   .scene = io::read_scene(study.scene, scenario.overrides),
                   .beginning = ""};
    if (const std::optional<Scene> beginning = io::beginning_of(run.scene)) {
      run.beginning = io::scene_hash(*beginning);
      if (++uses[run.beginning] == 2) plan.beginnings.emplace(run.beginning, *beginning);
    }
    plan.runs.push_back(std::move(run));
  }
  return plan;
}

fs::path beginning_folder(const fs::path& directory, const std::string& beginning) {
  return directory / "shared" / beginning;
}

std::optional<Json> finished_record(const fs::path& folder) {
  const fs::path file = folder / "run.json";
  if (!fs::exists(file)) return std::nullopt;
  Json record = Json::parse(io::read_text(file), nullptr, false);
  const bool is_record = record.is_object() && record.contains("ended") && record.contains("scene");
  if (!is_record || record["ended"] == "failed") return std::nullopt;
  return record;
}

bool continues_beginning(const Json& record, const PlannedRun& run) {
  if (run.beginning.empty()) return false;
  // The name alone: the directory may have been moved since.
  const Json& last = record.at("scene").at("stage").back();
  return last.contains("begin_from") &&
         fs::path(last["begin_from"].get<std::string>()).filename() == run.beginning;
}

bool is_record_of(const Json& record, const PlannedRun& run) {
  const Json asked = io::scene_to_json(run.scene);
  Json scene = record.at("scene");
  if (scene.contains("stage") && scene["stage"].size() == asked["stage"].size() &&
      continues_beginning(record, run))
    scene["stage"].back().erase("begin_from");
  return scene == asked;
}

} // namespace scarp::apps
