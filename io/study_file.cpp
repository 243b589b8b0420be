#include "io/study_file.hpp"

#include "io/scene_file.hpp"
#include "io/section_reader.hpp"
#include "io/study_schema.hpp"
#include "io/table.hpp"
#include "io/text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace scarp::io {
namespace {
namespace fs = std::filesystem;

using Parameter = StudyText::Parameter;

constexpr std::size_t most_combinations = 10000;

// 001, 002 ...; as many digits as the last one needs.
std::string generated_name(std::size_t index, std::size_t count) {
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(count).size());
  return fmt::format("{:0{}}", index + 1, digits);
}

class StudyReader {
 public:
  explicit StudyReader(const fs::path& file)
      : directory_(file.parent_path()), report_(file.string()) {}

  Study read(const toml::table& file) {
    read_sections(file);
    check_parameters();
    read_scenarios(file);
    check_names();
    if (report_.lines().empty()) {
      fill_overrides();
      check_scenes();
    }
    if (std::vector<std::string> problems = report_.lines(); !problems.empty())
      throw SceneError(std::move(problems));
    return std::move(study_);
  }

 private:
  fs::path found(const std::string& path) const { return (directory_ / path).lexically_normal(); }

  void read_sections(const toml::table& file) {
    const StudySchema schema = study_schema({});
    SectionReader read(
        file, {schema.parameter.name, schema.table.name, schema.scenario.name, schema.measure.name},
        2, report_);
    read(schema.top, text_);
    read(schema.parameter, text_.parameters);
    if (file.contains(schema.table.name)) read(schema.table, text_.table);
    if (file.contains(schema.scenario.name))
      read(study_schema(text_.parameters).scenario, text_.scenarios);
    read(schema.measure, text_.measure);

    study_.title = text_.title;
    study_.scene = found(text_.scene);
    study_.measure = text_.measure;
    for (const Parameter& parameter : text_.parameters) study_.parameters.push_back(parameter.name);
  }

  void check_parameters() {
    std::map<std::string, std::string> owners; // of the scene's keys
    for (const StudyText::Setting& setting : text_.set) owners[setting.key] = "[set]";
    std::set<std::string> names = {"name", "scenario"}; // what [[scenario]] and results.csv have
    for (std::size_t i = 0; i < text_.parameters.size(); ++i) {
      const Parameter& parameter = text_.parameters[i];
      const std::string place = item_key("parameter", text_.parameters, i);
      if (!parameter.name.empty() && !names.insert(parameter.name).second)
        report_.problem(place + ".name", fmt::format("is '{}', which is something else's name; "
                                                     "must be the only one of its name",
                                                     parameter.name));
      for (const std::string& key : parameter.keys) {
        const auto [owner, is_new] = owners.emplace(key, place);
        if (!is_new)
          report_.problem(place + ".keys", fmt::format("holds '{}', which {} has too; must be the "
                                                       "only one that sets it",
                                                       key, owner->second));
      }
    }
  }

  void read_scenarios(const toml::table& file) {
    bool combinations = false;
    for (std::size_t i = 0; i < text_.parameters.size(); ++i)
      combinations = combinations || report_.placed(values_place(i));
    const bool table = file.contains("table");
    const bool list = file.contains("scenario");
    if (!report_.usable({"parameter", "table", "scenario"})) return;
    if (combinations + table + list != 1)
      report_.problem("scenario",
                      fmt::format("is given {}; must be given once: by 'values' of every "
                                  "[[parameter]], by a [table], or by [[scenario]]",
                                  combinations + table + list == 0 ? "nowhere" : "more than once"));
    else if (combinations)
      combine_values();
    else if (table)
      read_table_rows();
    else
      for (std::size_t i = 0; i < text_.scenarios.size(); ++i) {
        std::vector<double> inputs;
        for (const std::string& parameter : study_.parameters)
          inputs.push_back(text_.scenarios[i].inputs[parameter]);
        add(text_.scenarios[i].name, inputs, item_key("scenario", text_.scenarios, i) + ".name");
      }
  }

  void add(const std::string& name, const std::vector<double>& inputs, const std::string& place) {
    study_.scenarios.push_back({name, inputs, {}});
    places_.push_back(place);
  }

  std::string values_place(std::size_t parameter) const {
    return item_key("parameter", text_.parameters, parameter) + ".values";
  }

  void combine_values() {
    std::size_t count = 1;
    for (std::size_t i = 0; i < text_.parameters.size(); ++i) {
      const std::size_t values = text_.parameters[i].values.size();
      const std::string place = values_place(i);
      if (!report_.placed(place))
        report_.problem(place, "is missing; must be given, as another parameter has values");
      count *= values;
      if (count > most_combinations) {
        report_.problem(place, fmt::format("makes more than {0} combinations; must make at most "
                                           "{0}",
                                           most_combinations));
        return;
      }
    }
    for (std::size_t combination = 0; combination < count; ++combination) {
      std::vector<double> inputs(text_.parameters.size());
      std::size_t rest = combination;
      for (std::size_t i = inputs.size(); i-- > 0;) {
        const std::vector<double>& values = text_.parameters[i].values;
        inputs[i] = values[rest % values.size()];
        rest /= values.size();
      }
      add(generated_name(combination, count), inputs, "parameter");
    }
  }

  void read_table_rows() {
    if (!report_.usable({"table.file"})) return;
    const fs::path file = found(text_.table.file);
    try {
      const TextTable table = read_text_table(file);
      if (table.rows.empty()) report_.problem("table.file", "has no row; must have at least one");
      const auto column = [&](const std::string& key, const std::string& name) {
        const auto place = std::ranges::find(table.names, name);
        if (place == table.names.end())
          report_.problem(key, with_hint(fmt::format("has no column '{}'; must have it beside {}",
                                                     name, quoted_list(table.names, "and")),
                                         did_you_mean(name, table.names)));
        return static_cast<std::size_t>(place - table.names.begin());
      };
      std::vector<std::size_t> columns;
      for (const std::string& parameter : study_.parameters)
        columns.push_back(column("table.file", parameter));
      const bool named = !text_.table.name_column.empty();
      const std::size_t names = named ? column("table.file", text_.table.name_column) : 0;
      if (!report_.usable({"table.file"})) return;
      for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const std::string at = fmt::format("{}:{}", file.string(), table.lines[row]);
        const std::string name =
            named ? table.rows[row][names] : generated_name(row, table.rows.size());
        if (!is_scenario_name(name))
          report_.problem("table.name_column",
                          fmt::format("names a scenario '{}' ({}); must name it by {}", name, at,
                                      scenario_name_rule));
        std::vector<double> inputs;
        inputs.reserve(columns.size());
        for (const std::size_t i : columns) inputs.push_back(input(table.rows[row][i], at));
        add(name, inputs, "table.name_column");
      }
    } catch (const std::runtime_error& error) {
      report_.problem("table.file", error.what());
    }
  }

  double input(const std::string& cell, const std::string& at) {
    double value = std::nan("");
    try {
      value = parse_number(cell);
    } catch (const std::runtime_error&) { // reported with those that are no finite numbers
    }
    if (!std::isfinite(value))
      report_.problem("table.file",
                      fmt::format("holds '{}' ({}); must hold finite numbers", cell, at));
    return value;
  }

  void check_names() {
    std::set<std::string> names;
    for (std::size_t i = 0; i < study_.scenarios.size(); ++i) {
      const std::string& name = study_.scenarios[i].name;
      if (!name.empty() && !names.insert(name).second)
        report_.problem(places_[i],
                        fmt::format("gives '{}' to two scenarios; must give each its own", name));
    }
  }

  // And, beside each, what of the study it comes from.
  void fill_overrides() {
    for (const StudyText::Setting& setting : text_.set) {
      for (Scenario& scenario : study_.scenarios)
        scenario.overrides.push_back(setting.key + "=" + setting.value);
      sources_.emplace_back("set");
    }
    for (std::size_t i = 0; i < text_.parameters.size(); ++i) {
      const Parameter& parameter = text_.parameters[i];
      for (const std::string& key : parameter.keys) {
        for (Scenario& scenario : study_.scenarios) {
          const double value = scenario.inputs[i] * parameter.scale / parameter.divide_by;
          scenario.overrides.push_back(key + "=" + number_text(value));
        }
        sources_.push_back(item_key("parameter", text_.parameters, i) + ".keys");
      }
    }
  }

  // Each problem once, however many scenarios have it.
  void check_scenes() {
    std::map<std::pair<std::string, std::string>, std::set<std::string>> found_in;
    std::vector<std::pair<std::string, std::string>> order;
    const auto add_problem = [&](const std::string& key, const std::string& what,
                                 const std::string& scenario) {
      if (found_in[{key, what}].empty()) order.emplace_back(key, what);
      found_in[{key, what}].insert(scenario);
    };
    for (const Scenario& scenario : study_.scenarios) {
      try {
        const double end = end_time(read_scene(study_.scene, scenario.overrides));
        if (study_.measure.loading_start > end)
          add_problem("measure.loading_start_s",
                      fmt::format("is {}, after the end of the run; must be at most {}",
                                  number_text(study_.measure.loading_start), number_text(end)),
                      scenario.name);
      } catch (const SceneError& error) {
        for (const std::string& line : error.problems()) {
          const auto [key, what] = placed(line, scenario.overrides);
          add_problem(key, what, scenario.name);
        }
      }
    }
    for (const auto& problem : order) {
      const std::set<std::string>& names = found_in[problem];
      std::string where;
      if (names.size() < study_.scenarios.size())
        where = fmt::format(" (scenario '{}'{})", *names.begin(),
                            names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "");
      report_.problem(problem.first, problem.second + where);
    }
  }

  // A problem of a scene as one of the study: that of the override it names, or of the scene.
  std::pair<std::string, std::string> placed(const std::string& line,
                                             const std::vector<std::string>& overrides) const {
    for (std::size_t i = 0; i < overrides.size(); ++i) {
      const std::string start = fmt::format("{}{}: ", override_prefix, overrides[i]);
      if (!line.starts_with(start)) continue;
      const std::string key = overrides[i].substr(0, overrides[i].find('='));
      return {sources_[i], key + ": " + line.substr(start.size())};
    }
    return {"scene", line};
  }

  fs::path directory_;
  SceneReport report_;
  StudyText text_;
  Study study_;
  std::vector<std::string> places_;  ///< of the scenarios' names in the study
  std::vector<std::string> sources_; ///< keys of the study that the overrides come from
};

} // namespace

Study read_study(const fs::path& file) { return StudyReader(file).read(parse_toml(file)); }

} // namespace scarp::io
