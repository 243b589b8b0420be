// What is kept of a run.
#include "io/scene_sections.hpp"

#include "core/fields.hpp"

#include <string>
#include <vector>

namespace scarp::io {

namespace {

std::vector<std::string> field_names() {
  std::vector<std::string> names;
  for (const FieldInfo& field : field_table()) names.push_back(field.name);
  return names;
}

} // namespace

Section<Monitor> monitor_section() {
  return {.name = "monitor",
          .help = "A point to be followed in history.csv; any number of [[monitor]].",
          .options = {
              name<Monitor>("Name of its columns in history.csv."),
              required(vector<Monitor>(
                  "position_m", "m", &Monitor::position,
                  "Where it is at time 0: the nearest material point is followed.")),
          }};
}

Section<Output> output_section() {
  return {
      .name = "output",
      .help = "What the frames hold.",
      .options = {
          Declaration<Output>{
              .key = "fields",
              .unit = "",
              .allowed = "a list of different words out of " + quoted_list(field_names(), "and"),
              .help = "Fields to write; an empty list: all.",
              .read = [](const toml::node& node, int,
                         Output& output) { return read_words(node, field_names(), output.fields); },
              .write = [](const Output& output, int) -> Json { return output.fields; }},
          Declaration<Output>{
              .key = "front_regions",
              .unit = "",
              .allowed = "a list of different names of regions",
              .help = "Regions whose largest x is front_x_m in history.csv; an empty list: all.",
              .read = [](const toml::node& node, int,
                         Output& output) { return read_name_list(node, output.front_regions); },
              .write = [](const Output& output, int) -> Json { return output.front_regions; }}}};
}

} // namespace scarp::io
