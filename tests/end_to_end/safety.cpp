// scarp safety: what it writes and how it complains.
#include "tests/end_to_end/program.hpp"

#include <nlohmann/json.hpp>

namespace scarp::test {

using Safety = EndToEnd;

TEST_F(Safety, WritesTheFactorItsTrialsAndFigures) {
  const Result result = scarp({"safety", "block.toml", "--out", "out", "--tolerance", "0.1",
                               "--set", "material.rods.cohesion_Pa=1500"});
  expect_success(result); // no progress line: this is no terminal
  EXPECT_NE(result.out.find("factor of safety "), std::string::npos) << result.out;
  EXPECT_EQ(names_in(*this / "out"),
            (std::vector<std::string>{"displacement.png", "plastic_strain.png", "safety.json"}));
  const auto record = nlohmann::json::parse(content(*this / "out/safety.json"));
  const double stable = record["bracket"][0], failed = record["bracket"][1];
  EXPECT_EQ(record["factor"], failed);
  EXPECT_LE(failed - stable, 0.1);
  EXPECT_EQ(record["tolerance"], 0.1);
  for (const auto& trial : record["trials"]) {
    const double factor = trial["factor"];
    EXPECT_EQ(trial["verdict"], factor < failed ? "stable" : "failed") << factor;
    EXPECT_EQ(trial["displacement_m"] > record["failure"]["displacement_m"], factor >= failed);
    EXPECT_GE(trial["kinetic_energy_J_per_m"], 0.0);
    EXPECT_GT(trial["wall_s"], 0.0);
  }
}

TEST_F(Safety, AFactorBeyondTheSearchIsAFailureThatKeepsItsTrials) {
  expect_complaint(scarp({"safety", "block.toml", "--out", "out", "--lower", "1", "--upper", "2"}),
                   1, {"fails already at F = 1", "--lower"});
  const auto record = nlohmann::json::parse(content(*this / "out/safety.json"));
  EXPECT_TRUE(record["factor"].is_null());
  EXPECT_EQ(record["trials"].size(), 2U);
}

TEST_F(Safety, AMistakeIsOneLineAndLeavesNothing) {
  const auto complains = [&](std::vector<std::string> more, const std::vector<std::string>& words) {
    more.insert(more.begin(), {"safety", "block.toml", "--out", "out"});
    expect_complaint(scarp(more), 2, words);
    EXPECT_FALSE(fs::exists(*this / "out"));
  };
  complains({"--tolerance", "0"}, {"--tolerance: is 0", "above 0"});
  complains({"--lower", "2", "--upper", "2"}, {"--upper: is 2", "above 2"});
  complains({"--periods", "10"}, {"--periods: is 10"});
  std::string text = small_scene;
  text.replace(text.find("drucker_prager"), 14, "linear_elastic");
  text.replace(text.find("cohesion_Pa = 0\n"), 16, "");
  text.replace(text.find("friction_angle_deg = 19.8\n"), 26, "");
  write_scene(text);
  complains({}, {"no region has a Drucker-Prager material"});
}

} // namespace scarp::test
