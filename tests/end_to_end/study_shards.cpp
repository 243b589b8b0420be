// scarp study --shard I/N: parts of a study, run by calls that know nothing of each other.
#include "tests/end_to_end/study_fixture.hpp"

#include <cstdlib>
#include <fstream>

namespace scarp::test {

using StudyShards = StudyTest;

/// But for the time they took.
void expect_equal_results(const fs::path& one, const fs::path& other) {
  auto left = results_in(one);
  auto right = results_in(other);
  for (auto* results : {&left, &right})
    for (auto& [name, values] : *results)
      for (const char* unequal : {"wall_s", "rest_time_s", "after_rest_fraction"})
        values.erase(unequal); // the latter two are NaN
  EXPECT_EQ(left, right);
}

TEST_F(StudyShards, TogetherAreTheWholeStudy) {
  Program first(directory_, study_words({"--shard", "1/2"}));
  Program second(directory_, study_words({"--shard", "2/2"}));
  const Result results[] = {first.wait(), second.wait()};
  for (const Result& result : results) expect_success(result);
  EXPECT_TRUE(results[0].out.starts_with("2 of 2 scenarios finished (2 ")) << results[0].out;
  EXPECT_TRUE(results[1].out.starts_with("1 of 1 scenarios finished (1 ")) << results[1].out;
  EXPECT_FALSE(fs::exists(*this / "out/results.csv"));
  EXPECT_EQ(names_in(*this / "out/shared").size(), 1U);

  const Result collected = study({"--collect"});
  expect_success(collected);
  EXPECT_EQ(collected.out, "3 of 3 scenarios in out/results.csv\n");
  expect_success(scarp({"study", "study.toml", "--out", "whole"}));
  expect_equal_results(*this / "out", *this / "whole");
}

TEST_F(StudyShards, MayBeMoreThanTheScenarios) {
  const Result result = study({"--shard", "5/5"});
  expect_success(result);
  EXPECT_TRUE(result.out.starts_with("0 of 0 scenarios finished")) << result.out;
}

TEST_F(StudyShards, AreCollectedAsFarAsTheyAre) {
  expect_success(study({"--shard", "2/3"}));
  const Result collected = study({"--collect"});
  expect_success(collected);
  EXPECT_EQ(collected.out, "1 of 3 scenarios in out/results.csv; 2 missing: a, c\n");
}

/// As the README has it, with a stand-in for ssh that runs the command on this machine.
TEST_F(StudyShards, RunOnSeveralHostsWithGnuParallel) {
  if (std::system("parallel --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "GNU parallel is not installed";
  write("ssh", "#!/bin/sh\n" // HOST -- COMMAND
               "echo \"$1\" >> hosts.txt\n"
               "shift 2\n"
               "exec sh -c \"$*\"\n");
  fs::permissions(*this / "ssh", fs::perms::owner_all);
  ::setenv("PARALLEL_HOME", (*this / "parallel").c_str(), 1);
  fs::create_directory(*this / "parallel");
  const std::string trial = "cd " + directory_.string() + " && parallel --will-cite --ssh " +
                            (*this / "ssh").string() +
                            " --sshlogin node1 echo works ::: 1 2>/dev/null | grep -q works";
  if (std::system(trial.c_str()) != 0)
    GTEST_SKIP() << "GNU parallel runs nothing here, not even echo (a root without /dev)";
  fs::remove(*this / "hosts.txt");
  Program parallel(
      directory_,
      {"--will-cite", "--ssh", (*this / "ssh").string(), "-j", "1", "--sshlogin", "node1,node2",
       "--workdir", directory_.string(),
       std::string(SCARP_PROGRAM) + " study study.toml --out out --jobs 1 --shard {}/2", ":::", "1",
       "2"},
      "parallel");
  const Result result = parallel.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(lines_of(result.out).size(), 2U) << result.out;
  const std::string hosts = content(*this / "hosts.txt");
  for (const char* host : {"node1", "node2"})
    EXPECT_NE(hosts.find(host), std::string::npos) << hosts;
  expect_success(study({"--collect"}));
  expect_success(scarp({"study", "study.toml", "--out", "whole"}));
  expect_equal_results(*this / "out", *this / "whole");
}

} // namespace scarp::test
