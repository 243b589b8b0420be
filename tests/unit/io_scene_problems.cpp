#include "io_scene_problems.hpp"

using namespace scarp::io;
using namespace scarp::test;

TEST(SceneProblems, AllAtOnceInTheOrderOfTheFileThenOverrides) {
  const std::vector<std::string> problems = problems_of(R"([grid]
dimension = 3
cell_size_m = -1
lower_m = [0, 0]
upper_m = [1, 1, 1]
[[material]]
name = "a"
[[region]]
name = "r"
material = "b"
box_m = [[0, 0], [1, 1]]
)",
                                                        {"time.end=1", "grid.points_per_cell=0"});
  std::string lines;
  for (const std::string& problem : problems) lines += problem + "\n";
  EXPECT_EQ(lines,
            R"(3:15: grid.cell_size_m: is -1; must be a number > 0, in m
4:11: grid.lower_m: is an array of 2; must be [x, z] (3-D: [x, y, z]), finite numbers in m
6:1: material.a.law: is missing; must be 'linear_elastic' or 'drucker_prager'
6:1: material.a.density_kg_m3: is missing; must be a number > 0, in kg/m3
6:1: material.a.poissons_ratio: is missing; must be a number > -1 and < 0.5
6:1: material.a.youngs_modulus_Pa: is missing; must be a number > 0, in Pa; 'bulk_modulus_Pa' may replace it
10:12: region.r.material: is 'b'; must be the name of a [[material]]: 'a' (did you mean 'a'?)
11:9: region.r.box_m: has a corner 0 that is an array of 2; must be two corners [[x, z], [x, z]] (3-D: [[x, y, z], [x, y, z]]), the lower first, finite numbers in m
--set grid.points_per_cell=0: is 0; must be a whole number from 1 to 10
--set time.end=1: time.output_interval_s: is missing; must be a number > 0, in s
--set time.end=1: is unknown; must be one of 'end_s', 'output_interval_s', 'history_interval_s', 'cfl', 'max_step_s', 'rest_energy_fraction' and 'rest_duration_s' (did you mean 'end_s'?)
--set time.end=1: time.end_s: is missing; must be a number > 0, in s, where there is no [[stage]]
)");
}

TEST(SceneProblems, ThreeDimensions) {
  std::string text = good_scene;
  const auto replace = [&](const std::string& old_text, const std::string& new_text) {
    text.replace(text.find(old_text), old_text.size(), new_text);
  };
  replace("[grid]", "[grid]\ndimension = 3");
  replace("[0, -9.81]", "[0, 0, -9.81]");
  replace("[0, 0]", "[0, 0, 0]");
  replace("[2, 1]", "[2, 1.25, 1]");
  replace("[0.5, 0.5]", "[0.5, 0.5, 0.5]");
  EXPECT_EQ(problems_of(text),
            (std::vector<std::string>{
                "7:11: grid.upper_m: leaves 12.5 cells of 0.1 m: y runs from 0 to 1.25; must be a "
                "whole number of cells above grid.lower_m",
                "29:1: region.pile.depth_m: is missing; must be [y, y], the lower first, finite "
                "numbers in m; 'box_m' may replace it"}));
  replace("1.25", "1.5");
  replace("polygon_m", "depth_m = [1, 2]\npolygon_m");
  EXPECT_EQ(problems_of(text),
            std::vector<std::string>{"32:11: region.pile.depth_m: runs from 1 to 2, outside the "
                                     "grid, where y runs from 0 to 1.5; must lie inside"});
  replace("[1, 2]", "[1, 1]");
  EXPECT_EQ(problems_of(text), std::vector<std::string>{
                                   "32:11: region.pile.depth_m: runs from 1 to 1; must be [y, y], "
                                   "the lower first, finite numbers in m"});
  replace("[1, 1]", "[0, 1]");
  EXPECT_EQ(problems_of(text), std::vector<std::string>());
}

TEST(SceneProblems, Overrides) {
  const auto problem = [](const std::string& override_text) {
    const std::vector<std::string> problems = problems_of(good_scene, {override_text});
    return problems.size() == 1 ? problems[0] : std::to_string(problems.size()) + " problems";
  };
  EXPECT_EQ(problem("grid.cell_size_m=-1"),
            "--set grid.cell_size_m=-1: is -1; must be a number > 0, in m");
  EXPECT_EQ(problem("method.scheme=muls"),
            "--set method.scheme=muls: is 'muls'; must be 'usf', 'usl' or 'musl' (did you mean "
            "'musl'?)");
  EXPECT_EQ(problem("gird.cell_size_m=1"),
            "--set gird.cell_size_m=1: gird: is unknown; must be one of 'grid', 'walls', 'time', "
            "'method', 'material', 'region', 'gate', 'stage', 'monitor', 'output', 'title' and "
            "'gravity_m_s2' (did you mean 'grid'?)");
  EXPECT_EQ(
      problem("material.siol.cohesion_Pa=1"),
      "--set material.siol.cohesion_Pa=1: 'material' has no entry named 'siol'; it has 'soil' "
      "and 'rock' (did you mean 'soil'?)");
  EXPECT_EQ(problem("material.2.cohesion_Pa=1"),
            "--set material.2.cohesion_Pa=1: 'material' has no entry 2; it has 2, counted from 0");
  EXPECT_EQ(problem("material.rock.cohesion_Pa=1"),
            "--set material.rock.cohesion_Pa=1: is not used here; must be left out unless law = "
            "\"drucker_prager\"");
  EXPECT_EQ(problem("grid.cell_size_m.x=1"),
            "--set grid.cell_size_m.x=1: 'grid.cell_size_m' is not a section");
  for (const std::string text : {"grid", "=3", "grid..x=3", ".=1"})
    EXPECT_EQ(problem(text),
              "--set " + text + ": is not of the form key=value, such as grid.cell_size_m=0.01");
  EXPECT_EQ(problem("time.end_s="), "--set time.end_s=: '' is no TOML value: Error while parsing "
                                    "key-value pair: encountered end-of-file");
  EXPECT_EQ(problem("time.end_s=1\ncfl=2"), "--set time.end_s=1\ncfl=2: holds more than one value");
}

TEST(SceneProblems, FilesThatCannotBeRead) {
  EXPECT_EQ(error_of<SceneError>([] { read_scene("/none.toml"); }),
            "/none.toml: cannot read: No such file or directory");
  EXPECT_EQ(error_of<SceneError>([] { read_scene("/tmp"); }), "/tmp: cannot read: Is a directory");
}
