// scarp study: calls that do not come to their end.
#include "tests/end_to_end/study_fixture.hpp"

#include <csignal>
#include <thread>

namespace scarp::test {

/// Scenario a takes a moment; b and c, at once or one after the other, never end.
class InterruptedStudy : public StudyTest {
 protected:
  InterruptedStudy() {
    change_study("[set]", "[set]\n\"walls.x_upper\" = \"symmetry\"");
    change_study("stage.slide.body_force.block", "stage.slide.duration_s");
    change_study("pull = 2", "pull = 0.04");
    change_study("pull = 2", "pull = 4000");
    change_study("pull = 3", "pull = 4000");
  }

  void let_them_end() const {
    change_study("pull = 4000", "pull = 0.04");
    change_study("pull = 4000", "pull = 0.04");
  }

  /// One job: a has finished then.
  void await_second() const { await(*this / "out/b.partial/history.csv"); }
};

TEST_F(InterruptedStudy, KilledItLeavesOnlyWholeAndPartialRunsAndGoesOnLater) {
  const std::string out = (*this / "out").string();
  {
    Program program(directory_, {"study", "study.toml", "--out", out, "--jobs", "1"});
    await_second();
    program.kill();
    EXPECT_EQ(program.wait().signal, SIGKILL);
  }
  expect_no_processes_with(out); // the runs die with it
  EXPECT_EQ(names_in(*this / "out"), (std::vector<std::string>{".study-1-of-1.lock", ".study.lock",
                                                               "a", "b.partial", "shared"}));
  const auto a = times("out/a");
  let_them_end();
  const Result result = study();
  expect_success(result);
  EXPECT_TRUE(result.out.starts_with("3 of 3 scenarios finished (2 in this call, ")) << result.out;
  EXPECT_EQ(times("out/a"), a);
  EXPECT_EQ(names_in(*this / "out"),
            (std::vector<std::string>{".study-1-of-1.lock", ".study.lock", "a", "b", "c",
                                      "results.csv", "shared"}));
}

TEST_F(InterruptedStudy, KilledDuringTheBeginningItRunsThatAgain) {
  change_study("[set]", "[set]\n\"stage.rise.duration_s\" = 1000");
  {
    Program program(directory_, study_words());
    await(*this / "out/shared");
    while (names_in(*this / "out/shared").empty()) std::this_thread::yield();
    program.kill();
    program.wait();
  }
  const std::vector<std::string> left = names_in(*this / "out/shared");
  ASSERT_EQ(left.size(), 1U);
  EXPECT_TRUE(left[0].ends_with(".1-of-1.partial")) << left[0];
  change_study("\"stage.rise.duration_s\" = 1000", "");
  let_them_end();
  expect_success(study());
  ASSERT_EQ(names_in(*this / "out/shared").size(), 1U);
  EXPECT_NE(names_in(*this / "out/shared"), left);
}

TEST_F(InterruptedStudy, AskedToEndItStopsItsRunsAndKeepsWhatHasFinished) {
  const std::string out = (*this / "out").string();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    fs::remove_all(*this / "out");
    Program program(directory_, {"study", "study.toml", "--out", out, "--jobs", "1"});
    await_second();
    program.kill(signal);
    expect_complaint(program.wait(), 1, {"stopped (", "1 of 3 scenarios finished"});
    EXPECT_EQ(processes_with(out), std::vector<std::string>());
    EXPECT_EQ(names_in(*this / "out"),
              (std::vector<std::string>{".study-1-of-1.lock", ".study.lock", "a", "shared"}));
  }
}

/// A call for the same scenarios would take the first one's folders away.
TEST_F(InterruptedStudy, IsRefusedWhileAnotherIsAtIt) {
  const Program program(directory_, study_words({"--shard", "1/2"}));
  await(*this / "out/shared");
  expect_complaint(study({"--shard", "1/2"}), 2,
                   {"another process is at this study", "out/.study-1-of-2.lock"});
  expect_complaint(study(), 2, {"another process is at this study", "out/.study.lock"});
  expect_success(study({"--shard", "4/4"})); // shards go side by side; this one is empty
}

} // namespace scarp::test
