// scarp bench accuracy and speed: what it writes, and its exit codes.
#include "tests/end_to_end/program.hpp"

#include <nlohmann/json.hpp>

#include <fstream>

namespace scarp::test {

using Bench = EndToEnd;

TEST_F(Bench, AccuracyWritesItsRecordFiguresAndPage) {
  const Result result = scarp({"bench", "accuracy", "--out", "out", "--quick", "--only", "column",
                               "--only", "stress-paths", "--only", "work-bar"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto record = nlohmann::json::parse(content(*this / "out/accuracy.json"));
  EXPECT_EQ(record.at("quick"), true);
  const auto& checks = record.at("verification");
  EXPECT_TRUE(checks.contains("stress-paths.triaxial_compression"));
  for (const auto& [name, check] : checks.items()) {
    EXPECT_EQ(check.at("pass"), true) << name;
    for (const char* key : {"value", "reference", "bound", "unit", "source"})
      EXPECT_TRUE(check.contains(key)) << name << " " << key;
  }
  EXPECT_FALSE(checks.contains("bar.frequency_order")) << "not asked for";
  EXPECT_GT(record.at("convergence").at("column").at(0).at("order"), 0.9);
  EXPECT_FALSE(record.at("work_precision").empty());
  const std::string page = content(*this / "out/index.html");
  EXPECT_NE(page.find("column.stress_order"), std::string::npos);
  for (const char* figure : {"column.png", "stress-paths.png", "work-bar.png"})
    EXPECT_TRUE(std::filesystem::exists(*this / "out" / figure)) << figure;
}

TEST_F(Bench, SpeedWritesItsRecordAndFigure) {
  const Result result = scarp({"bench", "speed", "--out", "out", "--quick"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "") << "progress is for terminals";
  for (const char* words : {"GFLOP/s", "GB/s", "Ratios and bounds", "plane strain, linear: memory"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words;
  const auto record = nlohmann::json::parse(content(*this / "out/speed.json"));
  ASSERT_TRUE(record.is_array());
  for (const auto& entry : record) {
    for (const char* key : {"scene", "dim", "shape", "precision", "threads", "points",
                            "point_steps_per_s", "fraction_of_peak_flops", "bytes_per_point"})
      EXPECT_TRUE(entry.contains(key)) << key;
    for (const char* phase : {"sort", "P2G", "grid", "G2P", "remap", "stress", "output"})
      EXPECT_GT(entry.at("phases").at(phase), 0.0) << phase;
  }
  EXPECT_EQ(lines_of(content(*this / "out/speed.csv")).size(), record.size() + 1);
  EXPECT_TRUE(std::filesystem::exists(*this / "out/speed.png"));
  EXPECT_TRUE(nlohmann::json::parse(content(*this / "out/machine.json")).contains("rooflines"));
}

TEST_F(Bench, SaysWhatIsWrongWithTheCall) {
  EXPECT_EQ(scarp({"bench"}).exit_code, 2);
  EXPECT_EQ(scarp({"bench", "accuracy"}).exit_code, 2);
  EXPECT_EQ(scarp({"bench", "accuracy", "--out", "out", "--only", "nonsense"}).exit_code, 2);
  EXPECT_EQ(scarp({"bench", "speed"}).exit_code, 2);
  std::ofstream(*this / "file") << "in the way";
  expect_complaint(scarp({"bench", "speed", "--out", "file"}), 2, {"--out", "file"});
}

} // namespace scarp::test
