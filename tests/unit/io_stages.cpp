#include "core/error.hpp"
#include "core/run.hpp"
#include "io/frame_file.hpp"
#include "io/run_recorder.hpp"
#include "io/scene_file.hpp"
#include "io/snapshot.hpp"
#include "tests/unit/io_scene_problems.hpp"

#include <gtest/gtest.h>

using namespace scarp;
using namespace scarp::test;

namespace {

constexpr const char* good_stages = R"(
[[stage]]
name = "load"
duration_s = 0.5
gravity = [[0, 0], [0.5, 1]]
material = { pile = "rock" }
[[stage]]
name = "slide"
start_s = 0.5
duration_s = 1
body_force = { pile = 3 }
)";

/// The good scene with stages instead of an end, and a piece of the text replaced.
std::string with_stages(const std::string& old_text = "", const std::string& new_text = "") {
  std::string text = std::string(good_scene) + good_stages;
  text.replace(text.find("end_s = 1\n"), 10, "\n");
  const std::size_t at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return text.replace(at, old_text.size(), new_text);
}

std::string problem_of(const std::string& old_text, const std::string& new_text) {
  std::string lines;
  for (const std::string& line : problems_of(with_stages(old_text, new_text)))
    lines += (lines.empty() ? "" : "\n") + line;
  return lines;
}

} // namespace

TEST(StageFile, ReadsEveryOption) {
  const Scene scene =
      io::read_scene(write_file(fresh_directory() / "s.toml",
                                with_stages("body_force = { pile = 3 }",
                                            "body_force = { pile = 3 }\nbegin_from = \"out/x\"")));
  ASSERT_EQ(scene.stages.size(), 2U);
  const Stage& load = scene.stages[0];
  EXPECT_EQ(load.name, "load");
  EXPECT_EQ(load.duration, 0.5);
  EXPECT_EQ(load.gravity.points, (std::vector<std::array<double, 2>>{{0, 0}, {0.5, 1}}));
  EXPECT_EQ(load.material.at("pile"), "rock");
  const Stage& slide = scene.stages[1];
  EXPECT_EQ(slide.start, 0.5);
  EXPECT_EQ(slide.body_force.at("pile").at(7.0), 3.0);
  EXPECT_EQ(slide.begin_from, "out/x");
  EXPECT_EQ(end_time(scene), 1.5);
}

TEST(StageFile, PrintedAndReadAgain) {
  const fs::path directory = fresh_directory();
  const Scene scene = io::read_scene(write_file(directory / "a.toml", with_stages()));
  const std::string printed = io::scene_to_toml(scene);
  EXPECT_EQ(io::scene_to_toml(io::read_scene(write_file(directory / "b.toml", printed))), printed);
}

TEST(StageFile, OverridesReachIntoRegions) {
  const fs::path file = write_file(fresh_directory() / "s.toml", with_stages());
  const Scene scene = io::read_scene(file, {"stage.slide.body_force.pile=2.5",
                                            "stage.load.gravity=1", "stage.slide.duration_s=4"});
  EXPECT_EQ(scene.stages[1].body_force.at("pile").at(0.0), 2.5);
  EXPECT_TRUE(scene.stages[0].gravity.constant());
  EXPECT_EQ(end_time(scene), 4.5);
}

TEST(StageErrors, StagesThatOverlapOrLeaveAGap) {
  EXPECT_EQ(problem_of("start_s = 0.5", "start_s = 0.25"),
            "49:11: stage.slide.start_s: is 0.25, and overlaps the stage before, which ends at 0.5 "
            "s; must be 0.5");
  EXPECT_EQ(problem_of("start_s = 0.5", "start_s = 2"),
            "49:11: stage.slide.start_s: is 2, and leaves a gap after the stage before, which ends "
            "at 0.5 s; must be 0.5");
}

TEST(StageErrors, EndGivenTwiceOrNever) {
  EXPECT_EQ(problem_of("output_interval_s", "end_s = 1\noutput_interval_s"),
            "11:9: time.end_s: is given besides [[stage]]; must be left out, as the stages' "
            "durations say it");
  std::string text = good_scene;
  text.replace(text.find("end_s = 1\n"), 10, "\n");
  EXPECT_EQ(problems_of(text), std::vector<std::string>{
                                   "9:1: time.end_s: is missing; must be a number > 0, in s, where "
                                   "there is no [[stage]]"});
}

TEST(StageErrors, Names) {
  EXPECT_EQ(problem_of("body_force = { pile = 3 }", "body_force = { pule = 3 }"),
            "51:14: stage.slide.body_force: names 'pule'; must be the name of a [[region]]: 'pile' "
            "(did you mean 'pile'?)");
  EXPECT_EQ(problem_of("material = { pile = \"rock\" }", "material = { pule = \"rock\" }"),
            "46:12: stage.load.material: names 'pule'; must be the name of a [[region]]: 'pile' "
            "(did you mean 'pile'?)");
  EXPECT_EQ(
      problem_of("material = { pile = \"rock\" }", "material = { pile = \"rack\" }"),
      "46:12: stage.load.material: names 'rack'; must be the name of a [[material]]: 'soil' or "
      "'rock' (did you mean 'rock'?)");
  EXPECT_EQ(problem_of("name = \"slide\"", "name = \"load\""),
            "48:8: stage.1.name: is 'load', as that of stage.0; must be the only one of its name");
}

TEST(StageErrors, AMaterialKeepsTheMass) {
  EXPECT_EQ(problem_of("name = \"rock\"\nlaw = \"linear_elastic\"\ndensity_kg_m3 = 2000",
                       "name = \"rock\"\nlaw = \"linear_elastic\"\ndensity_kg_m3 = 2600"),
            "46:12: stage.load.material: gives region 'pile' the density 2600 of 'rock' instead of "
            "2000; must keep it, as mass is conserved");
}

TEST(StageErrors, Values) {
  EXPECT_EQ(problem_of("duration_s = 0.5", "duration_s = 0"),
            "44:14: stage.load.duration_s: is 0; must be a number > 0, in s");
  EXPECT_EQ(problem_of("[[0, 0], [0.5, 1]]", "[[0, 0], [0, 1]]"),
            std::string("45:11: stage.load.gravity: has the time 0 at point 1; must be ") +
                "a finite number, or [[TIME in s, number], ...] with ascending times >= 0, linear "
                "in between");
  EXPECT_EQ(
      problem_of("duration_s = 1\n", "duration_s = 1\nuntil_rest = true\n"),
      "51:14: stage.slide.until_rest: is true; must be false unless time.rest_energy_fraction "
      "says what rest is");
  EXPECT_EQ(
      problem_of("body_force = { pile = 3 }", "body_force = { pile = \"x\" }"),
      std::string("51:14: stage.slide.body_force: has 'pile', which is 'x'; must be { REGION = "
                  "FACTOR, ... }, each FACTOR a finite number, or [[TIME in s, number], ...] "
                  "with ascending times >= 0, linear in between"));
}

TEST(StageErrors, BeginsOnce) {
  std::string text = with_stages("body_force", "begin_from = \"x\"\nbody_force");
  text.replace(text.find("gravity = [[0"), 0, "begin_from = \"y\"\n");
  EXPECT_EQ(problems_of(text),
            std::vector<std::string>{"52:14: stage.slide.begin_from: is given as "
                                     "stage.load.begin_from is; must be given once"});
}

/// A later stage leaves the first one out, and with it how that begins.
TEST(StageErrors, TheStressOfAnotherRunIsTheInitialOne) {
  const std::string method = "initial_stress = \"static\"\n";
  std::string text = with_stages("body_force", "begin_from = \"x\"\nbody_force");
  text.replace(text.find("scheme ="), 0, method);
  EXPECT_EQ(problems_of(text), std::vector<std::string>{});
  text = with_stages("gravity = [[0", "begin_from = \"x\"\ngravity = [[0");
  text.replace(text.find("scheme ="), 0, method);
  const std::vector<std::string> problems = problems_of(text);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("method.initial_stress: is 'static', and stage.load.begin_from brings "
                             "a stress along; must be 'none'"),
            std::string::npos)
      << problems[0];
}

/// The last frame of a run that did the first stage only.
TEST(BeginFrom, TheLastFrameOfAnotherRun) {
  const fs::path directory = fresh_directory();
  const fs::path file = write_file(directory / "s.toml", with_stages());
  const auto quick = [&](std::vector<std::string> overrides) {
    overrides.insert(overrides.end(), {"time.output_interval_s=0.01", "stage.load.duration_s=0.02",
                                       "stage.slide.start_s=0.02", "stage.slide.duration_s=0.01",
                                       "output.fields=[]"});
    return io::read_scene(file, overrides);
  };
  Scene first = quick({});
  first.stages.pop_back();
  {
    const auto simulation = io::make_simulation_from_files(first);
    io::RunRecorder recorder(first, *simulation, directory / "first", "first", 1);
    run(*simulation, first.timing, recorder);
  }
  const std::string from = "stage.slide.begin_from=" + (directory / "first").string();
  const auto simulation = io::make_simulation_from_files(quick({from}));
  EXPECT_EQ(simulation->time(), 0.02);
  EXPECT_EQ(simulation->stage().name, "slide");
  const auto written = io::read_frame(directory / "first" / "first_000002.vtp").column("stress");
  const auto taken_over = simulation->field("stress");
  ASSERT_EQ(taken_over.size(), written.values.size());
  for (std::size_t i = 0; i < taken_over.size(); ++i) // tau = J sigma and back rounds
    EXPECT_DOUBLE_EQ(taken_over[i], written.values[i]);

  Scene late = quick({from});
  late.stages[0].duration = 0.03;
  EXPECT_THROW(io::make_simulation_from_files(late), SetupError) << "ends too early";
  Scene nowhere = quick({});
  nowhere.stages[1].begin_from = (directory / "nothing").string();
  EXPECT_THROW(io::make_simulation_from_files(nowhere), std::runtime_error);
}
