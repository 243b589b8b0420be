#include "io_study_problems.hpp"

#include <ostream>

using namespace scarp::io;
using namespace scarp::test;

namespace {

using Problems = std::vector<std::string>;

/// The good study with a part replaced.
struct Case {
  std::string what;
  std::string old_text;
  std::string new_text;
  Problems problems;

  friend void PrintTo(const Case& c, std::ostream* stream) { *stream << c.what; }
};

class BadStudy : public testing::TestWithParam<Case> {};

const std::string name_rule_text =
    "must be a word of at most 100 letters, digits, '_' and '-', neither 'shared' nor '-' first";

const Case cases[] = {
    {"NoToml", "[set]", "[set", {"study.toml:3:5: "}},
    {"UnknownTopKey",
     "title",
     "titel",
     {"study.toml:1:1: titel: is unknown; must be one of 'parameter', 'table', 'scenario', "
      "'measure', 'title', 'scene' and 'set' (did you mean 'title'?)"}},
    {"UnknownKey",
     "scale =",
     "scal =",
     {"study.toml:9:1: parameter.cohesion_kPa.scal: is unknown; must be one of 'name', 'keys', "
      "'scale', 'divide_by' and 'values' (did you mean 'scale'?)"}},
    {"UnknownMeasure",
     "toe_x_m",
     "toe_x",
     {"study.toml:22:1: measure.toe_x: is unknown; must be one of 'toe_x_m', 'thickness_m', "
      "'smoothing_s', 'loading_start_s', 'rest_fraction' and 'rest_duration_s' (did you mean "
      "'toe_x_m'?)"}},
    {"BadMeasure",
     "rest_fraction = 0.01",
     "rest_fraction = 1",
     {"study.toml:25:17: measure.rest_fraction: is 1; must be a number > 0 and < 1"}},
    {"LoadingAfterTheEnd",
     "loading_start_s = 1",
     "loading_start_s = 2.5",
     {"study.toml:27:19: measure.loading_start_s: is 2.5, after the end of the run; must be at "
      "most 2"}},
    {"NoParameter",
     "[[parameter]]\nname = \"cohesion_kPa\"\nkeys = [\"material.soil.cohesion_Pa\"]\nscale = "
     "1000\n[[parameter]]\nname = \"friction_deg\"\nkeys = "
     "[\"material.soil.friction_angle_deg\"]\n[[scenario]]\nname = \"soft\"\ncohesion_kPa = "
     "0.5\nfriction_deg = 20\n[[scenario]]\nname = \"1-hard\"\nfriction_deg = 30\ncohesion_kPa = "
     "2\n",
     "",
     {"study.toml:1:1: parameter: is missing; must be at least one section, headed "
      "[[parameter]]"}},
    {"TwoParametersOfAName",
     "\"friction_deg\"",
     "\"cohesion_kPa\"",
     {"study.toml:11:8: parameter.1.name: is 'cohesion_kPa', which is something else's name; must "
      "be the only one of its name",
      "study.toml:16:1: scenario.soft.friction_deg: is unknown; must be one of 'name', "
      "'cohesion_kPa' and 'cohesion_kPa'",
      "study.toml:19:1: scenario.1.friction_deg: is unknown; must be one of 'name', "
      "'cohesion_kPa' and 'cohesion_kPa'"}},
    {"KeysAreNoList",
     "[\"material.soil.cohesion_Pa\"]",
     "\"material.soil.cohesion_Pa\"",
     {"study.toml:8:8: parameter.cohesion_kPa.keys: is 'material.soil.cohesion_Pa'; must be a list "
      "of keys of the scene, as `--set` takes them"}},
    {"KeysWithAValue",
     "cohesion_Pa\"]",
     "cohesion_Pa=3\"]",
     {"study.toml:8:8: parameter.cohesion_kPa.keys: holds 'material.soil.cohesion_Pa=3'; must be a "
      "list of keys of the scene, as `--set` takes them"}},
    {"UnknownKeyOfTheScene",
     "soil.cohesion_Pa",
     "soil.cohesion",
     {"study.toml:8:8: parameter.cohesion_kPa.keys: material.soil.cohesion: is unknown; must be "
      "one of 'name', 'law', 'density_kg_m3', 'poissons_ratio', 'youngs_modulus_Pa', "
      "'bulk_modulus_Pa', 'cohesion_Pa', 'friction_angle_deg', 'dilation_angle_deg', 'cone', "
      "'tension_cutoff_Pa', 'opening', 'residual_plastic_strain', 'peak_plastic_strain', "
      "'residual_cohesion_Pa', 'residual_friction_angle_deg', 'residual_dilation_angle_deg', "
      "'rate_strengthening', 'rate_strengthening_limit' and 'grain_diameter_m' (did you mean "
      "'cohesion_Pa'?)"}},
    {"UnknownMaterialOfTheScene",
     "soil.cohesion_Pa",
     "siol.cohesion_Pa",
     {"study.toml:8:8: parameter.cohesion_kPa.keys: material.siol.cohesion_Pa: 'material' has no "
      "entry named 'siol'; it has 'soil' and 'rock' (did you mean 'soil'?)"}},
    {"KeySetTwice",
     "[\"material.soil.friction_angle_deg\"]",
     "[\"time.end_s\", \"material.soil.cohesion_Pa\"]",
     {"study.toml:12:8: parameter.friction_deg.keys: holds 'time.end_s', which [set] has too; must "
      "be the only one that sets it",
      "study.toml:12:8: parameter.friction_deg.keys: holds 'material.soil.cohesion_Pa', which "
      "parameter.cohesion_kPa has too; must be the only one that sets it"}},
    {"ValueOutOfRange",
     "friction_deg = 30",
     "friction_deg = 95",
     {"study.toml:12:8: parameter.friction_deg.keys: material.soil.friction_angle_deg: is 95; must "
      "be a number >= 0 and < 90, in deg (scenario '1-hard')"}},
    {"SetOutOfRange",
     "\"time.end_s\" = 2",
     "\"method.flip\" = 2",
     {"study.toml:3:1: set: method.flip: is 2; must be a number >= 0 and <= 1"}},
    {"SetIsNoSection",
     "[set]\n\"method.scheme\" = \"usf\"\n\"time.end_s\" = 2",
     "set = 3",
     {"study.toml:3:7: set: is 3; must be a section, headed [set], of keys of the scene and their "
      "values"}},
    {"NoScene", "scene = \"s.toml\"", "", {"study.toml:1:1: scene: is missing; must be a file"}},
    {"SceneCannotBeRead",
     "s.toml",
     "none.toml",
     {"study.toml:2:9: scene: none.toml: cannot read: No such file or directory"}},
    {"ValueMissing",
     "cohesion_kPa = 2\n",
     "",
     {"study.toml:17:1: scenario.1.cohesion_kPa: is missing; must be a number"}},
    {"ValueOfNoParameter",
     "cohesion_kPa = 2\n",
     "cohesion_kPa = 2\nwater_m = 3\n",
     {"study.toml:21:1: scenario.1.water_m: is unknown; must be one of 'name', 'cohesion_kPa' and "
      "'friction_deg'"}},
    {"NameTwice",
     "1-hard",
     "soft",
     {"study.toml:18:8: scenario.1.name: gives 'soft' to two scenarios; must give each its own"}},
    {"NameOfADirectoryElsewhere",
     "1-hard",
     "../hard",
     {"study.toml:18:8: scenario.1.name: is '../hard'; " + name_rule_text}},
    {"NameOfTheSharedDirectory",
     "1-hard",
     "shared",
     {"study.toml:18:8: scenario.shared.name: is 'shared'; " + name_rule_text}},
    {"NoScenario",
     "[[scenario]]\nname = \"soft\"\ncohesion_kPa = 0.5\nfriction_deg = 20\n[[scenario]]\nname = "
     "\"1-hard\"\nfriction_deg = 30\ncohesion_kPa = 2\n",
     "",
     {"study.toml:1:1: scenario: is given nowhere; must be given once: by 'values' of every "
      "[[parameter]], by a [table], or by [[scenario]]"}},
    {"ValuesBesideScenarios",
     "scale = 1000",
     "values = [1, 2]",
     {"study.toml:13:1: scenario: is given more than once; must be given once: by 'values' of "
      "every [[parameter]], by a [table], or by [[scenario]]"}},
};

Problems grid_problems(const std::string& cohesion, const std::string& friction) {
  std::string text = good_study;
  text.erase(text.find("[[scenario]]"));
  text.insert(text.find("[[parameter]]\nname = \"friction"), cohesion);
  return problems_of_study(write_study(text + friction));
}

Problems table_problems(const std::string& table) {
  const fs::path file = write_study(table_study);
  write_file(file.parent_path() / "t.csv", table);
  return problems_of_study(file);
}

} // namespace

TEST_P(BadStudy, IsTold) {
  const Case& bad = GetParam();
  std::string text = good_study;
  const std::size_t at = text.find(bad.old_text);
  ASSERT_NE(at, std::string::npos);
  const Problems problems =
      problems_of_study(write_study(text.replace(at, bad.old_text.size(), bad.new_text)));
  if (bad.what == "NoToml") {
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_TRUE(problems[0].starts_with(bad.problems[0])) << problems[0];
    EXPECT_TRUE(problems[0].ends_with("; must be TOML")) << problems[0];
    return;
  }
  EXPECT_EQ(problems, bad.problems);
}

INSTANTIATE_TEST_SUITE_P(Studies, BadStudy, testing::ValuesIn(cases),
                         [](const auto& bad) { return bad.param.what; });

TEST(StudyProblems, AllAtOnce) {
  std::string text = good_study;
  text.replace(text.find("scene"), 5, "scen ");
  text.replace(text.find("0.5"), 3, "\"a\"");
  text.replace(text.find("smoothing_s = 0.25"), 18, "smoothing_s = 0");
  EXPECT_EQ(problems_of_study(write_study(text)),
            (Problems{"study.toml:1:1: scene: is missing; must be a file",
                      "study.toml:2:1: scen: is unknown; must be one of 'parameter', 'table', "
                      "'scenario', 'measure', 'title', 'scene' and 'set' (did you mean 'scene'?)",
                      "study.toml:15:16: scenario.soft.cohesion_kPa: is 'a'; must be a number",
                      "study.toml:24:15: measure.smoothing_s: is 0; must be a number > 0, in s"}));
}

TEST(StudyProblems, OfCombinations) {
  EXPECT_EQ(grid_problems("values = [1, 2]\n", ""),
            Problems{"study.toml:11:1: parameter.friction_deg.values: is missing; must be given, "
                     "as another parameter has values"});
  EXPECT_EQ(grid_problems("values = []\n", "values = [20]\n"),
            Problems{"study.toml:10:10: parameter.cohesion_kPa.values: is an array of 0; must be a "
                     "list of different finite numbers"});
  EXPECT_EQ(grid_problems("values = [1, 1]\n", "values = [20]\n"),
            Problems{"study.toml:10:10: parameter.cohesion_kPa.values: holds 1 twice; must be a "
                     "list of different finite numbers"});
  std::string many = "values = [0";
  for (int i = 1; i < 101; ++i) many += ", " + std::to_string(i);
  EXPECT_EQ(grid_problems(many + "]\n", many + "]\n"),
            Problems{"study.toml:14:10: parameter.friction_deg.values: makes more than 10000 "
                     "combinations; must make at most 10000"});
  // The two scenarios of four that have it are told of once.
  EXPECT_EQ(grid_problems("values = [1, 2]\n", "values = [20, 95]\n"),
            Problems{"study.toml:13:8: parameter.friction_deg.keys: "
                     "material.soil.friction_angle_deg: is 95; must be a number >= 0 and < 90, in "
                     "deg (scenario '002' and 1 more)"});
}

TEST(StudyProblems, OfATable) {
  std::string no_file = table_study;
  no_file.erase(no_file.find("file"), 15);
  EXPECT_EQ(problems_of_study(write_study(no_file)),
            Problems{"study.toml:9:1: table.file: is missing; must be a file"});
  EXPECT_EQ(problems_of_study(write_study(table_study)),
            Problems{"study.toml:10:8: table.file: t.csv: cannot read: No such file or directory"});
  EXPECT_EQ(table_problems("name,friction,cohesion_kPa\na,1,1\n"),
            (Problems{"study.toml:10:8: table.file: has no column 'friction_deg'; must have it "
                      "beside 'name', 'friction' and 'cohesion_kPa' (did you mean 'friction'?)",
                      "study.toml:10:8: table.file: has no column 'id'; must have it beside "
                      "'name', 'friction' and 'cohesion_kPa'"}));
  EXPECT_EQ(table_problems("id,friction_deg,cohesion_kPa\n"),
            Problems{"study.toml:10:8: table.file: has no row; must have at least one"});
  EXPECT_EQ(table_problems("id,friction_deg,cohesion_kPa\na,20\n"),
            Problems{"study.toml:10:8: table.file: t.csv:2: 2 values for 3 columns"});
  EXPECT_EQ(
      table_problems("id,friction_deg,cohesion_kPa\na b,20,\na,nan,1\na,20,1\n"),
      (Problems{"study.toml:10:8: table.file: holds '' (t.csv:2); must hold finite numbers",
                "study.toml:10:8: table.file: holds 'nan' (t.csv:3); must hold finite numbers",
                "study.toml:11:15: table.name_column: names a scenario 'a b' (t.csv:2); must name "
                "it by a word of at most 100 letters, digits, '_' and '-', neither 'shared' nor "
                "'-' first",
                "study.toml:11:15: table.name_column: gives 'a' to two scenarios; must give each "
                "its own"}));
}

/// What is wrong with the scene itself stands there, with its own place.
TEST(StudyProblems, OfTheScene) {
  const fs::path file = write_study(good_study);
  std::string scene = good_scene;
  scene.replace(scene.find("friction_angle_deg = 25"), 23,
                "friction_angle_deg = 25\ndilation_angle_deg = 25");
  write_file(file.parent_path() / "s.toml", scene);
  EXPECT_EQ(problems_of_study(file),
            Problems{"study.toml:2:9: scene: s.toml:22:22: material.soil.dilation_angle_deg: is "
                     "25; must be at most the friction angle, 20 (scenario 'soft')"});
}
