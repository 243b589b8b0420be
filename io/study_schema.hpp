// Every section and option of a study file, once.
#pragma once

#include "core/analysis/measures.hpp"
#include "io/scene_option.hpp"

#include <map>
#include <string>
#include <vector>

namespace scarp::io {

/// What a study file says, as it stands there.
struct StudyText {
  struct Setting {
    std::string key;
    std::string value; ///< TOML
  };
  struct Parameter {
    std::string name;
    std::vector<std::string> keys; ///< of the scene
    double scale = 1.0;
    double divide_by = 1.0;
    std::vector<double> values; ///< of a grid; else empty
  };
  struct Table {
    std::string file;
    std::string name_column; ///< empty: none
  };
  struct Entry {
    std::string name;
    std::map<std::string, double> inputs; ///< by parameter
  };

  std::string title;
  std::string scene;
  std::vector<Setting> set;
  std::vector<Parameter> parameters;
  Table table;
  std::vector<Entry> scenarios;
  analysis::MeasureOptions measure;
};

struct StudySchema {
  Section<StudyText> top;
  Section<StudyText::Parameter> parameter;
  Section<StudyText::Table> table;
  Section<StudyText::Entry> scenario;
  Section<analysis::MeasureOptions> measure;
};

/// The options of [[scenario]] are the parameters, by their names.
StudySchema study_schema(const std::vector<StudyText::Parameter>& parameters);

/// A scenario's name is that of its directory, which is unlike those that a study makes besides.
bool is_scenario_name(const std::string& text);
inline constexpr const char* scenario_name_rule =
    "a word of at most 100 letters, digits, '_' and '-', neither 'shared' nor '-' first";

} // namespace scarp::io
