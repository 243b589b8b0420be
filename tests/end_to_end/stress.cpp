// scarp stress: what it writes, and that what it finds can be run again.
#include "tests/end_to_end/program.hpp"

#include <nlohmann/json.hpp>

namespace scarp::test {

using Stress = EndToEnd;

TEST_F(Stress, ReportsWhatFails) {
  const Result result =
      scarp({"stress", "--scenes", "60", "--seed", "1", "--jobs", "2", "--out", "out"});
  const auto record = nlohmann::json::parse(content(*this / "out/stress.json"));
  EXPECT_EQ(record.at("scenes"), 60);
  EXPECT_EQ(record.at("seed"), 1);
  EXPECT_EQ(record.at("refused"), 0);
  EXPECT_GT(record.at("wall_s"), 0.0);
  const auto& failures = record.at("failures");
  EXPECT_EQ(record.at("failed"), failures.size());
  EXPECT_EQ(result.exit_code, failures.empty() ? 0 : 1);
  EXPECT_LE(failures.size(), 4U) << "4 when this was written: no new ones, please";
  EXPECT_TRUE(result.out.starts_with("check ")) << result.out;
  const std::string& summary = failures.empty() ? result.out : result.err;
  EXPECT_NE(summary.find("60 scenes: " + std::to_string(failures.size()) + " failed, 0 refused"),
            std::string::npos)
      << summary;

  for (const auto& failure : failures) {
    const std::string file = failure.at("file");
    EXPECT_FALSE(failure.at("check").get<std::string>().empty());
    EXPECT_EQ(scarp({"info", "--all", "out/" + file}).exit_code, 0) << file;
    if (failure.at("check") == "leaving") { // the solver itself gives up
      EXPECT_EQ(scarp({"run", "out/" + file, "--out", "again"}).exit_code, 1) << file;
    }
  }
}

TEST_F(Stress, SaysWhatIsWrongWithTheCall) {
  EXPECT_EQ(scarp({"stress"}).exit_code, 2);
  EXPECT_EQ(scarp({"stress", "--out", "out", "--scenes", "0"}).exit_code, 2);
  EXPECT_EQ(scarp({"stress", "--out", "out", "--jobs", "0"}).exit_code, 2);
  EXPECT_EQ(scarp({"stress", "--out", "out", "--seed", "one"}).exit_code, 2);
}

} // namespace scarp::test
