#include "io/scene_schema.hpp"

#include "io/scene_sections.hpp"

#include <algorithm>

namespace scarp::io {

namespace {

Section<Scene> top_section() {
  return {.name = "",
          .help = "Options of the whole scene, before the first section.",
          .options = {
              Declaration<Scene>{
                  .key = "title",
                  .unit = "",
                  .allowed = "a string",
                  .help = "A line for people: it heads figures and listings.",
                  .read = [](const toml::node& node, int,
                             Scene& scene) { return read_text_value(node, scene.title); },
                  .write = [](const Scene& scene, int) -> Json { return scene.title; }},
              vector<Scene>("gravity_m_s2", "m/s2", &Scene::gravity,
                            "Gravity; in plane strain [x, 0, z] is allowed as well.", read_gravity),
          }};
}

} // namespace

const SceneSchema& scene_schema() {
  static const SceneSchema schema = {.top = top_section(),
                                     .grid = grid_section(),
                                     .walls = walls_section(),
                                     .time = time_section(),
                                     .method = method_section(),
                                     .material = material_section(),
                                     .region = region_section(),
                                     .gate = gate_section(),
                                     .stage = stage_section(),
                                     .monitor = monitor_section(),
                                     .output = output_section()};
  return schema;
}

Scene default_scene() {
  Scene scene;
  scene.method = method_of(Preset::accurate);
  scene.timing.cfl = usual_cfl(scene.method);
  return scene;
}

std::vector<std::string> excluded_by(const std::string& section, const std::string& key) {
  std::vector<std::string> excluded;
  const Scene scene;
  for_each_section(scene, [&]<typename T>(const Section<T>& declared, const auto&) {
    if (declared.name != section) return;
    for (const Option<T>& option : declared.options) {
      const std::vector<std::string>& replaced = option.instead_of;
      if (option.key == key) excluded.insert(excluded.end(), replaced.begin(), replaced.end());
      if (std::ranges::find(replaced, key) != replaced.end()) excluded.push_back(option.key);
    }
  });
  return excluded;
}

} // namespace scarp::io
