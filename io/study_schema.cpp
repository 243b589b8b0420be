#include "io/study_schema.hpp"

#include "io/section_print.hpp"
#include "io/study_file.hpp"

#include <algorithm>

namespace scarp::io {
namespace {

template <typename T>
Option<T> words(const std::string& key, std::string T::*member, const std::string& allowed,
                const std::string& help) {
  return Declaration<T>{.key = key,
                        .unit = "",
                        .allowed = allowed,
                        .help = help,
                        .read = [=](const toml::node& node, int,
                                    T& section) { return read_text_value(node, section.*member); },
                        .write = [=](const T& section, int) -> Json {
                          return (section.*member).empty() ? Json() : Json(section.*member);
                        }};
}

// Null for what JSON has not: dates and times.
Json json_of(const toml::node& node) {
  if (const auto* value = node.as_boolean()) return value->get();
  if (const auto* value = node.as_integer()) return value->get();
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_string()) return value->get();
  Json values;
  if (const toml::array* array = node.as_array()) {
    values = Json::array();
    for (const toml::node& entry : *array) values.push_back(json_of(entry));
  } else if (const toml::table* table = node.as_table()) {
    values = Json::object();
    for (const auto& [key, entry] : *table) values[std::string(key.str())] = json_of(entry);
  }
  return values;
}

// "grid.flip" = 1 and grid.flip = 1 are the same; a table in braces is a value.
void add_settings(const toml::table& table, const std::string& prefix,
                  std::vector<StudyText::Setting>& settings) {
  for (const auto& [key, entry] : table) {
    const std::string name = prefix + std::string(key.str());
    const toml::table* section = entry.as_table();
    if (section != nullptr && !section->is_inline())
      add_settings(*section, name + ".", settings);
    else
      settings.push_back({name, toml_text(json_of(entry))});
  }
}

Option<StudyText> settings() {
  return Declaration<StudyText>{
      .key = "set",
      .unit = "",
      .allowed = "a section, headed [set], of keys of the scene and their values",
      .help = "Values that all scenarios have instead of the scene's, as `--set` gives them: "
              "`\"time.output_interval_s\" = 3`.",
      .read = [](const toml::node& node, int, StudyText& study) -> Complaint {
        if (!node.is_table()) return {"is " + shown(node)};
        add_settings(*node.as_table(), "", study.set);
        return {};
      },
      .write = [](const StudyText&, int) -> Json { return nullptr; }};
}

Complaint read_keys(const toml::node& node, std::vector<std::string>& keys) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) return {"is " + shown(node)};
  std::vector<std::string> read;
  for (const toml::node& entry : *array) {
    const auto* key = entry.as_string();
    if (key == nullptr || key->get().find('=') != std::string::npos)
      return {"holds " + shown(entry)};
    read.push_back(key->get());
  }
  keys = read;
  return {};
}

Complaint read_values(const toml::node& node, std::vector<double>& values) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) return {"is " + shown(node)};
  std::vector<double> read;
  for (const toml::node& entry : *array) {
    double value = 0.0;
    if (read_number(entry, {}, value)) return {"holds " + shown(entry)};
    if (std::ranges::find(read, value) != read.end()) return {"holds " + shown(entry) + " twice"};
    read.push_back(value);
  }
  values = read;
  return {};
}

using Parameter = StudyText::Parameter;

Section<Parameter> parameter_section() {
  return {
      .name = "parameter",
      .help = "A quantity that differs between scenarios; one [[parameter]] for each.",
      .options =
          {
              name<Parameter>("Its column in results.csv and in the table; with the unit."),
              required<Parameter>(Declaration<Parameter>{
                  .key = "keys",
                  .unit = "",
                  .allowed = "a list of keys of the scene, as `--set` takes them",
                  .help = "What gets scale * value / divide_by.",
                  .read = [](const toml::node& node, int,
                             Parameter& parameter) { return read_keys(node, parameter.keys); },
                  .write = [](const Parameter& parameter, int) -> Json { return parameter.keys; }}),
              number<Parameter>("scale", "", &Parameter::scale, {},
                                "From the value to the scene's: 1000 from kPa to Pa."),
              number<Parameter>("divide_by", "", &Parameter::divide_by, {.above = 0},
                                "The same where the inverse is no exact decimal."),
              Declaration<Parameter>{
                  .key = "values",
                  .unit = "",
                  .allowed = "a list of different finite numbers",
                  .help = "The scenarios are all combinations of the parameters' values, named "
                          "001, 002 ...; the last parameter changes first.",
                  .read = [](const toml::node& node, int,
                             Parameter& parameter) { return read_values(node, parameter.values); },
                  .write = [](const Parameter& parameter, int) -> Json {
                    return parameter.values.empty() ? Json() : Json(parameter.values);
                  }},
          },
      .needed = true};
}

Section<StudyText::Table> table_section() {
  return {.name = "table",
          .help = "The scenarios are the rows of a table of comma-separated values with one header "
                  "line; '#' begins a comment. Columns that are no parameter's are passed over.",
          .options = {
              required(words("file", &StudyText::Table::file, "a file",
                             "The table; its path starts at the study's directory.")),
              words("name_column", &StudyText::Table::name_column, "a column of the table",
                    "The scenarios' names; without it they are 001, 002 ..."),
          }};
}

Option<StudyText::Entry> scenario_name() {
  using Entry = StudyText::Entry;
  return required<Entry>(
      Declaration<Entry>{.key = "name",
                         .unit = "",
                         .allowed = scenario_name_rule,
                         .help = "Its directory and its row in results.csv.",
                         .read = [](const toml::node& node, int, Entry& entry) -> Complaint {
                           const auto* name = node.as_string();
                           if (name == nullptr || !is_scenario_name(name->get()))
                             return {"is " + shown(node)};
                           entry.name = name->get();
                           return {};
                         },
                         .write = [](const Entry& entry, int) -> Json { return entry.name; }});
}

Section<StudyText::Entry> scenario_section(const std::vector<StudyText::Parameter>& parameters) {
  using Entry = StudyText::Entry;
  Section<Entry> section{.name = "scenario",
                         .help = "The scenarios one by one. Besides its name each has a value for "
                                 "every parameter, under the "
                                 "parameter's name.",
                         .options = {scenario_name()},
                         .needed = true};
  for (const StudyText::Parameter& parameter : parameters)
    section.options.push_back(required<Entry>(
        Declaration<Entry>{.key = parameter.name,
                           .unit = "",
                           .allowed = "a number",
                           .help = "Value of the parameter.",
                           .read =
                               [name = parameter.name](const toml::node& node, int, Entry& entry) {
                                 return read_number(node, {}, entry.inputs[name]);
                               },
                           .write = nullptr}));
  return section;
}

Section<analysis::MeasureOptions> measure_section() {
  using Measure = analysis::MeasureOptions;
  return {
      .name = "measure",
      .help = "How results.csv measures a run: see core/analysis/measures.hpp.",
      .options = {
          number<Measure>("toe_x_m", "m", &Measure::toe, {},
                          "Where the run-out starts; it ends at the last front_x_m."),
          number<Measure>("thickness_m", "m", &Measure::thickness, {.above = 0},
                          "Thickness that energies are given for, in plane strain."),
          number<Measure>("smoothing_s", "s", &Measure::smoothing_width, {.above = 0},
                          "Width of the window that velocities are smoothed in."),
          number<Measure>("loading_start_s", "s", &Measure::loading_start, {.at_least = 0},
                          "No acceleration counts before."),
          number<Measure>("rest_fraction", "", &Measure::rest_fraction, {.above = 0, .below = 1},
                          "The slide rests while the nodes' kinetic energy is below this part of "
                          "its peak."),
          number<Measure>("rest_duration_s", "s", &Measure::rest_duration, {.at_least = 0},
                          "How long it rests before after_rest_fraction looks for new motion."),
      }};
}

} // namespace

StudySchema study_schema(const std::vector<StudyText::Parameter>& parameters) {
  return {.top = {.name = "",
                  .help = "Options of the whole study, before the first section.",
                  .options = {words("title", &StudyText::title, "a string", "A line for people."),
                              required(words("scene", &StudyText::scene, "a file",
                                             "The scene that the scenarios change; its path starts "
                                             "at the study's directory.")),
                              settings()}},
          .parameter = parameter_section(),
          .table = table_section(),
          .scenario = scenario_section(parameters),
          .measure = measure_section()};
}

bool is_scenario_name(const std::string& text) {
  const auto is_part = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || static_cast<unsigned char>(c) > 127; // of letters beyond ASCII
  };
  return !text.empty() && text.size() <= 100 && text != "shared" && text[0] != '-' &&
         std::ranges::all_of(text, is_part);
}

std::string study_reference_markdown() {
  const StudySchema schema = study_schema({});
  return "# Study files\n\n"
         "A study is a TOML file that says which scenarios of a scene to run: `scarp study "
         "STUDY.toml --out DIR`.\n"
         "The scenarios come from exactly one of three: `values` of every parameter (all their "
         "combinations), a\n"
         "[table], or [[scenario]]. Unknown keys are errors.\n\n"
         "This page is generated from the table of options in `io/study_schema.cpp`.\n" +
         reference_of(schema.top, "Top level") + reference_of(schema.parameter, "[[parameter]]") +
         reference_of(schema.table, "[table]") + reference_of(schema.scenario, "[[scenario]]") +
         reference_of(schema.measure, "[measure]");
}

} // namespace scarp::io
