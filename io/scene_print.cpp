#include "io/scene_file.hpp"

#include "core/fields.hpp"
#include "io/scene_schema.hpp"
#include "io/section_print.hpp"
#include "io/text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

namespace scarp::io {
namespace {

template <typename T> Json section_values(const Section<T>& section, const T& part, int dimension) {
  Json values = Json::object();
  for (const Option<T>& option : section.options) {
    if (option.exists && !option.exists(part, dimension)) continue;
    Json value = option.write(part, dimension);
    if (!value.is_null()) values[option.key] = std::move(value);
  }
  return values;
}

// The scene as JSON that still has infinite numbers.
Json values_of(const Scene& scene) {
  Json all = Json::object();
  for_each_section(scene,
                   [&]<typename T, typename Part>(const Section<T>& section, const Part& part) {
                     if constexpr (std::is_same_v<T, Part>) {
                       Json values = section_values(section, part, scene.grid.dimension);
                       if (section.name.empty())
                         all = std::move(values);
                       else
                         all[section.name] = std::move(values);
                     } else {
                       Json& list = all[section.name] = Json::array();
                       for (const T& entry : part)
                         list.push_back(section_values(section, entry, scene.grid.dimension));
                     }
                   });
  return all;
}

void name_infinities(Json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    value = number_text(value.get<double>());
  else if (value.is_structured())
    for (Json& entry : value) name_infinities(entry);
}

void append_table(std::string& text, const std::string& header, const Json& values) {
  text += fmt::format("{}{}\n", text.empty() ? "" : "\n", header);
  for (const auto& [key, value] : values.items())
    text += fmt::format("{} = {}\n", key, toml_text(value));
}

} // namespace

nlohmann::ordered_json scene_to_json(const Scene& scene) {
  Json values = values_of(scene);
  name_infinities(values);
  return values;
}

std::string scene_to_toml(const Scene& scene) {
  std::string text;
  std::string sections;
  const Json values = values_of(scene);
  for (const auto& [name, value] : values.items()) {
    const bool is_list = value.is_array() && (value.empty() || value.front().is_object());
    if (value.is_object())
      append_table(sections, fmt::format("[{}]", name), value);
    else if (!is_list)
      text += fmt::format("{} = {}\n", name, toml_text(value));
    else
      for (const Json& entry : value) append_table(sections, fmt::format("[[{}]]", name), entry);
  }
  return text + "\n" + sections;
}

std::string scene_reference_markdown() {
  std::string text =
      "# Scene files\n\n"
      "A scene is a TOML file. Everything is SI, angles are in degrees, z points up; keys end with "
      "their unit.\n"
      "Unknown keys are errors. `--set SECTION.KEY=VALUE` overrides a value; entries of lists go "
      "by "
      "name or index\n"
      "(`--set material.rods.cohesion_Pa=10`).\n\n"
      "This page is generated from the tables of options in `io/scene_sections_*.cpp`.\n";
  const Scene scene;
  for_each_section(scene, [&]<typename T, typename Part>(const Section<T>& section, const Part&) {
    const bool is_list = !std::is_same_v<T, Part>;
    const std::string header = section.name.empty() ? "Top level"
                               : is_list            ? fmt::format("[[{}]]", section.name)
                                                    : fmt::format("[{}]", section.name);
    text += reference_of(section, header);
  });
  text += "\n## Fields\n\nWhat `fields` of [output] chooses from. Tensors have the components "
          "xx yy zz xy yz xz.\n\n"
          "| name | components | unit | meaning |\n|---|---|---|---|\n";
  for (const FieldInfo& field : field_table())
    text += fmt::format("| `{}` | {} | {} | {} |\n", field.name, field.components, field.unit,
                        field.description);
  return text;
}

} // namespace scarp::io
