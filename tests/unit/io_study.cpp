#include "io/scene_file.hpp"
#include "io/study_file.hpp"

#include "io_study_problems.hpp"

using namespace scarp;
using namespace scarp::io;
using namespace scarp::test;

namespace {

const fs::path data = fs::path(SCARP_SOURCE_DIR) / "data";

std::vector<std::string> names_of(const Study& study) {
  std::vector<std::string> names;
  for (const Scenario& scenario : study.scenarios) names.push_back(scenario.name);
  return names;
}

const DruckerPrager& soil_of(const Scene& scene) {
  return std::get<DruckerPrager>(scene.materials.at(0).law);
}

} // namespace

TEST(Study, OfAListOfScenarios) {
  const Study study = read_study(write_study(good_study));
  EXPECT_EQ(study.title, "good");
  EXPECT_EQ(study.scene.filename(), "s.toml");
  EXPECT_EQ(study.parameters, (std::vector<std::string>{"cohesion_kPa", "friction_deg"}));
  EXPECT_EQ(names_of(study), (std::vector<std::string>{"soft", "1-hard"}));
  EXPECT_EQ(study.scenarios[0].inputs, (std::vector<double>{0.5, 20.0}));
  EXPECT_EQ(study.scenarios[0].overrides,
            (std::vector<std::string>{"method.scheme=\"usf\"", "time.end_s=2",
                                      "material.soil.cohesion_Pa=500",
                                      "material.soil.friction_angle_deg=20"}));
  EXPECT_EQ(study.measure.toe, 1.5);
  EXPECT_EQ(study.measure.thickness, 0.5);
  EXPECT_EQ(study.measure.smoothing_width, 0.25);
  EXPECT_EQ(study.measure.rest_fraction, 0.01);
  EXPECT_EQ(study.measure.rest_duration, 0.125);
  EXPECT_EQ(study.measure.loading_start, 1.0);

  const Scene scene = read_scene(study.scene, study.scenarios[1].overrides);
  EXPECT_EQ(scene.timing.end_time, 2.0);
  EXPECT_EQ(scene.method.scheme, Scheme::usf);
  EXPECT_EQ(soil_of(scene).cohesion, 2000.0);
  EXPECT_EQ(soil_of(scene).friction_angle, 30.0);
}

TEST(Study, MeasuresByDefaultAsTheLibraryDoes) {
  std::string text = good_study;
  text.erase(text.find("[measure]"));
  const analysis::MeasureOptions measure = read_study(write_study(text)).measure;
  EXPECT_EQ(measure.smoothing_width, analysis::MeasureOptions{}.smoothing_width);
  EXPECT_EQ(measure.thickness, 1.0);
}

/// A parameter may set several keys; its values are scaled exactly where a divisor can do it.
TEST(Study, OfAllCombinations) {
  const Study study = read_study(write_study(R"(scene = "s.toml"
[[parameter]]
name = "stiffness_MPa"
keys = ["material.soil.youngs_modulus_Pa", "material.rock.youngs_modulus_Pa"]
scale = 1e6
values = [1, 2.5]
[[parameter]]
name = "end_percent"
keys = ["time.end_s"]
divide_by = 98
values = [98, 196, 245]
)"));
  EXPECT_EQ(names_of(study), (std::vector<std::string>{"001", "002", "003", "004", "005", "006"}));
  EXPECT_EQ(study.scenarios[1].inputs, (std::vector<double>{1.0, 196.0}));
  EXPECT_EQ(study.scenarios[3].inputs, (std::vector<double>{2.5, 98.0}));
  EXPECT_EQ(
      study.scenarios[5].overrides,
      (std::vector<std::string>{"material.soil.youngs_modulus_Pa=2500000",
                                "material.rock.youngs_modulus_Pa=2500000", "time.end_s=2.5"}));
}

TEST(Study, GeneratedNamesAreAsLongAsTheLast) {
  std::string values = "0.001";
  for (int i = 2; i <= 1000; ++i) values += ", " + std::to_string(i) + "e-3";
  const Study study = read_study(write_study("scene = \"s.toml\"\n[[parameter]]\nname = \"p\"\n"
                                             "keys = [\"method.flip\"]\nvalues = [" +
                                             values + "]\n"));
  EXPECT_EQ(study.scenarios.front().name, "0001");
  EXPECT_EQ(study.scenarios.back().name, "1000");
}

TEST(Study, OfATable) {
  const fs::path file = write_study(table_study);
  write_file(file.parent_path() / "t.csv", "# source\nremark,id,friction_deg,cohesion_kPa\n"
                                           "as measured,s1,20,0.5\nguessed,s2,30,2\n");
  const Study study = read_study(file);
  EXPECT_EQ(names_of(study), (std::vector<std::string>{"s1", "s2"}));
  EXPECT_EQ(study.scenarios[1].inputs, (std::vector<double>{2.0, 30.0}));

  std::string text = table_study;
  text.erase(text.find("name_column"));
  write_file(file, text);
  EXPECT_EQ(names_of(read_study(file)), (std::vector<std::string>{"001", "002"}));
}

/// Sections within [set] and dotted keys mean the same; a table in braces is a value.
TEST(Study, SetsValuesOfAllKinds) {
  std::string text = good_study;
  text.replace(text.find("\"time.end_s\" = 2"), 16, R"(time.end_s = 2
"walls.z_lower" = { kind = "friction", coefficient = 0.5 }
"output.fields" = ["velocity", "stress"]
title = "it's 1e-20"
[set.grid]
lower_m = [-0.5, 0]
points_per_cell = 3)");
  const Study study = read_study(write_study(text));
  const Scene scene = read_scene(study.scene, study.scenarios[0].overrides);
  EXPECT_EQ(scene.timing.end_time, 2.0);
  EXPECT_EQ(scene.grid.walls[2][0].friction_coefficient, 0.5);
  EXPECT_EQ(scene.output.fields, (std::vector<std::string>{"velocity", "stress"}));
  EXPECT_EQ(scene.title, "it's 1e-20");
  EXPECT_EQ(scene.grid.lower[0], -0.5);
  EXPECT_EQ(scene.grid.points_per_cell, 3);
}

/// Table 1 of Wu et al. 2017: the surcharge is a multiple of 98 kPa, exactly.
TEST(Study, OfWu2017) {
  const Study study = read_study(data / "studies" / "wu2017.toml");
  ASSERT_EQ(study.scenarios.size(), 29U);
  EXPECT_EQ(study.scenarios.front().name, "1");
  EXPECT_EQ(study.scenarios.back().name, "29");
  EXPECT_EQ(study.scenarios[3].overrides,
            (std::vector<std::string>{"time.output_interval_s=3", "material.soil.cohesion_Pa=20000",
                                      "material.soil.friction_angle_deg=25",
                                      "stage.slide.body_force.surcharge=3.5"}));
}

TEST(Study, ReferenceIsUpToDate) {
  const std::string reference = study_reference_markdown();
  const fs::path file = data / "study_reference.md";
  if (reference == content(file)) return;
  const fs::path actual = write_file(fresh_directory() / "study_reference.md", reference);
  FAIL() << "refresh it: cp " << actual.string() << " " << file.string();
}
