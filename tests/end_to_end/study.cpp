// scarp study: the runs, what they have in common, what they measure, and what is run again.
#include "tests/end_to_end/study_fixture.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace scarp::test {

using Study = StudyTest;

TEST_F(Study, RunsEveryScenarioAndMeasuresIt) {
  const Result result = study();
  expect_success(result);
  EXPECT_TRUE(result.out.starts_with("3 of 3 scenarios finished (3 in this call, ")) << result.out;
  EXPECT_TRUE(result.out.ends_with(" s); results in out/results.csv\n")) << result.out;
  EXPECT_EQ(lines_of(result.out).size(), 1U);
  EXPECT_EQ(names_in(*this / "out"),
            (std::vector<std::string>{".study-1-of-1.lock", ".study.lock", "a", "b", "c",
                                      "results.csv", "shared"}));
  EXPECT_EQ(names_in(*this / "out/a"),
            (std::vector<std::string>{"history.csv", "log.txt", "run.json", "scene.pvd",
                                      "scene_000000.vtp", "scene_000001.vtp", "scene_000002.vtp"}));
  EXPECT_EQ(lines_of(content(*this / "out/results.csv")).front(),
            "scenario,friction_deg,pull,points,steps,peak_velocity_top_m_s,"
            "time_of_peak_velocity_top_s,peak_acceleration_top_m_s2,runout_m,"
            "peak_kinetic_energy_kJ,time_of_peak_kinetic_energy_s,rest_time_s,"
            "after_rest_fraction,thrown_points,scheme_loss_fraction,wall_s");

  // The same by hand, as one run without a shared beginning.
  expect_success(
      scarp({"run", "scene.toml", "--out", "whole", "--set", "method.flip=0.99", "--set",
             "material.rods.friction_angle_deg=20", "--set", "stage.slide.body_force.block=1.5"}));
  const auto record = nlohmann::json::parse(content(*this / "whole/run.json"));
  const io::Table history = io::read_table(*this / "whole/history.csv");
  const auto results = results_in(*this / "out");
  ASSERT_EQ(results.size(), 3U);
  const std::map<std::string, double>& c = results.at("c");
  EXPECT_EQ(c.at("friction_deg"), 20.0);
  EXPECT_EQ(c.at("pull"), 3.0);
  EXPECT_EQ(c.at("points"), 100.0);
  EXPECT_EQ(c.at("steps"), record.at("steps").get<double>());
  const std::vector<double>& kinetic = history.column("kinetic_J_per_m");
  const auto peak = std::ranges::max_element(kinetic);
  EXPECT_NEAR(c.at("peak_kinetic_energy_kJ"), 0.5e-3 * *peak, 1e-8 * *peak);
  EXPECT_NEAR(c.at("time_of_peak_kinetic_energy_s"),
              history.column("time_s")[static_cast<std::size_t>(peak - kinetic.begin())], 1e-9);
  EXPECT_NEAR(c.at("runout_m"), history.column("front_x_m").back() - 0.08, 1e-9);
  EXPECT_NEAR(c.at("scheme_loss_fraction"),
              history.column("scheme_loss_J_per_m").back() /
                  history.column("gravity_work_J_per_m").back(),
              1e-7);
  EXPECT_EQ(c.at("thrown_points"), 0.0);
  EXPECT_TRUE(std::isnan(c.at("rest_time_s"))) << "it is still sliding";
  const double velocity = *std::ranges::max_element(history.column("top_vx_m_s"));
  EXPECT_NEAR(c.at("peak_velocity_top_m_s"), velocity, 0.05 * velocity);
  EXPECT_GT(c.at("peak_velocity_top_m_s"), results.at("a").at("peak_velocity_top_m_s"));
}

TEST_F(Study, RunsASharedBeginningOnce) {
  expect_success(study());
  const std::vector<std::string> shared = names_in(*this / "out/shared");
  ASSERT_EQ(shared.size(), 1U);
  const fs::path beginning = *this / "out/shared" / shared[0];
  EXPECT_EQ(io::read_table(beginning / "history.csv").column("time_s").back(), 0.02);
  for (const char* name : {"a", "b", "c"}) {
    const io::Table history = io::read_table(*this / "out" / name / "history.csv");
    EXPECT_EQ(history.column("time_s").front(), 0.02);
    const auto record = nlohmann::json::parse(content(*this / "out" / name / "run.json"));
    EXPECT_EQ(record["scene"]["stage"][1]["begin_from"], beginning.string());
  }
}

/// Scenarios that differ from the start, and one that is alone.
TEST_F(Study, RunsWhatIsNotSharedAsAWhole) {
  change_study("material.rods.friction_angle_deg", "time.cfl");
  change_study("friction_deg = 20", "friction_deg = 0.2");
  change_study("friction_deg = 30", "friction_deg = 0.3");
  change_study("friction_deg = 20", "friction_deg = 0.25");
  expect_success(study());
  EXPECT_FALSE(fs::exists(*this / "out/shared"));
  EXPECT_EQ(io::read_table(*this / "out/b/history.csv").column("time_s").front(), 0.0);
}

TEST_F(Study, RunsNothingTwice) {
  expect_success(study());
  const auto before = times("out");
  const Result again = study({"--threads", "2"});
  expect_success(again);
  EXPECT_TRUE(again.out.starts_with("3 of 3 scenarios finished (0 in this call, ")) << again.out;
  auto after = times("out");
  after.at((*this / "out/results.csv").string()) = before.at((*this / "out/results.csv").string());
  EXPECT_EQ(after, before);

  // A directory may be moved: it is the same study.
  fs::rename(*this / "out", *this / "moved");
  expect_success(scarp({"study", "study.toml", "--out", "moved", "--collect"}));
  EXPECT_EQ(results_in(*this / "moved").size(), 3U);
  EXPECT_TRUE(scarp({"study", "study.toml", "--out", "moved"})
                  .out.starts_with("3 of 3 scenarios finished (0 in this call, "));
}

TEST_F(Study, RunsAgainWhatHasChanged) {
  expect_success(study());
  const auto results = results_in(*this / "out");
  const auto a = times("out/a");
  const auto shared = times("out/shared");
  change_study("friction_deg = 30", "friction_deg = 25");

  const Result collected = study({"--collect"});
  expect_success(collected);
  EXPECT_EQ(collected.out, "2 of 3 scenarios in out/results.csv; 1 missing: b\n");
  EXPECT_EQ(results_in(*this / "out").size(), 2U);

  const Result again = study();
  expect_success(again);
  ASSERT_EQ(lines_of(again.out).size(), 2U) << again.out;
  EXPECT_EQ(lines_of(again.out)[0], "scenario b is run again: its scene is another than before");
  EXPECT_TRUE(lines_of(again.out)[1].starts_with("3 of 3 scenarios finished (1 in this call, "));
  EXPECT_EQ(times("out/a"), a);
  EXPECT_EQ(times("out/shared"), shared);
  EXPECT_EQ(results_in(*this / "out").at("b").at("friction_deg"), 25.0);
  EXPECT_NE(results_in(*this / "out").at("b").at("runout_m"), results.at("b").at("runout_m"));
}

/// script (of Debian's essential bsdutils) gives it a terminal.
TEST_F(Study, TellsOnATerminalHowFarItIs) {
  if (std::system("script -qec true /dev/null > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "no terminal can be made here (a root without /dev/pts)";
  Program program(
      directory_,
      {"-qec", std::string(SCARP_PROGRAM) + " study study.toml --out out --jobs 1", "/dev/null"},
      "script");
  const Result result = program.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("\r\033[K1/3 finished, 1 running, 0 failed, "), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find(" elapsed, about "), std::string::npos) << result.out;
}

/// The others go on; it is tried again with the next call.
TEST_F(Study, OneFailedScenarioStopsNoOther) {
  change_study("pull = 2", "pull = 8000");
  const Result result = study();
  EXPECT_EQ(result.exit_code, 1);
  const std::vector<std::string> lines = lines_of(result.err);
  ASSERT_EQ(lines.size(), 2U) << result.err;
  EXPECT_TRUE(lines[0].starts_with("scarp: scenario a failed: the run failed: step ")) << lines[0];
  EXPECT_TRUE(lines[0].ends_with(" (out/a.failed/log.txt)")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("scarp: 2 of 3 scenarios finished (2 in this call, "));
  EXPECT_TRUE(lines[1].ends_with(" s), 1 failed; results in out/results.csv")) << lines[1];
  EXPECT_EQ(names_in(*this / "out"),
            (std::vector<std::string>{".study-1-of-1.lock", ".study.lock", "a.failed", "b", "c",
                                      "results.csv", "shared"}));
  EXPECT_EQ(results_in(*this / "out").size(), 2U);

  EXPECT_EQ(study().exit_code, 1);
  change_study("pull = 8000", "pull = 2");
  expect_success(study());
  EXPECT_FALSE(fs::exists(*this / "out/a.failed"));
  EXPECT_EQ(results_in(*this / "out").size(), 3U);
}

/// A time step beyond the critical one: already the beginning fails.
TEST_F(Study, AFailedBeginningFailsItsScenarios) {
  change_study("\"method.flip\" = 0.99", "\"gravity_m_s2\" = [90000, 0]");
  const Result result = study();
  EXPECT_EQ(result.exit_code, 1);
  const std::vector<std::string> lines = lines_of(result.err);
  ASSERT_EQ(lines.size(), 4U) << result.err;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(lines[i].starts_with(std::string("scarp: scenario ") + "abc"[i] +
                                     " failed: its shared beginning failed: the run failed: "))
        << lines[i];
  EXPECT_TRUE(lines[3].starts_with("scarp: 0 of 3 scenarios finished")) << lines[3];
}

TEST_F(Study, SaysWhatIsWrongWithTheCall) {
  for (const char* shard : {"0/2", "3/2", "1", "1/", "/2", "a/b", "1/2/3", "-1/2", "1/0"})
    expect_complaint(study({"--shard", shard}), 2,
                     {std::string("--shard ") + shard, "must be I/N", "I from 1 to N"});
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--collect", "--shard", "1/2"}, {"--jobs", "0"}, {"--threads", "0"}, {"more"}})
    EXPECT_EQ(study(more).exit_code, 2) << more.front();
  expect_complaint(study({"--collect"}), 2, {"none of the 3 scenarios has finished in out"});
  expect_complaint(scarp({"study", "none.toml", "--out", "out"}), 2, {"none.toml: cannot read"});
  change_study("friction_angle_deg", "friction_angle");
  expect_complaint(study(), 2, {"study.toml:6:8: parameter.friction_deg.keys", "did you mean"});
  EXPECT_FALSE(fs::exists(*this / "out"));
}

TEST_F(Study, TakesNoNameOfAResultAndNoPlaceOfAnythingElse) {
  fs::create_directories(*this / "out/b");
  std::ofstream(*this / "out/b/mine.txt") << "mine";
  expect_complaint(study(), 2, {"out/b is in the way of a scenario"});
  EXPECT_EQ(content(*this / "out/b/mine.txt"), "mine");
  EXPECT_FALSE(fs::exists(*this / "out/a"));

  std::string text = small_study;
  for (std::size_t at = 0; (at = text.find("pull", at)) != std::string::npos;)
    text.replace(at, 4, "steps");
  write("study.toml", text);
  expect_complaint(study(), 2, {"a parameter is named 'steps' as a result is"});
}

} // namespace scarp::test
