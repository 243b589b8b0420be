#include "io/scene_file.hpp"

#include "io/scene_checks.hpp"
#include "io/scene_overrides.hpp"
#include "io/scene_report.hpp"
#include "io/scene_schema.hpp"
#include "io/section_reader.hpp"

#include <fmt/format.h>

#include <utility>

namespace scarp::io {
namespace {

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  const Scene scene;
  for_each_section(scene, [&](const auto& section, const auto&) {
    if (!section.name.empty()) names.push_back(section.name);
  });
  return names;
}

// 0: the file's is wrong.
int dimension_of(const toml::table& file) {
  const toml::node_view<const toml::node> node = file["grid"]["dimension"];
  const std::int64_t dimension = node ? node.value_exact<std::int64_t>().value_or(0) : 2;
  return dimension == 2 || dimension == 3 ? static_cast<int>(dimension) : 0;
}

} // namespace

SceneError::SceneError(std::vector<std::string> problems)
    : std::runtime_error(fmt::format("{}", fmt::join(problems, "\n"))),
      problems_(std::move(problems)) {}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  SceneReport report(file.string());
  toml::table table = parse_toml(file);
  for (const std::string& text : overrides) apply_override(table, text, report);

  Scene scene = default_scene();
  for_each_section(scene, SectionReader(table, section_names(), dimension_of(table), report));
  if (!table.at_path("time.cfl")) scene.timing.cfl = usual_cfl(scene.method);
  check_scene(scene, report);
  if (std::vector<std::string> problems = report.lines(); !problems.empty())
    throw SceneError(std::move(problems));
  return scene;
}

} // namespace scarp::io
