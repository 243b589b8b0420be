// scarp run: what a run leaves on disk.
#include "tests/end_to_end/program.hpp"

#include "io/series.hpp"
#include "io/table.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace scarp::test {

using FinishedRun = EndToEnd;

/// gravity_work = change of (kinetic + strain) + losses, in every row.
void expect_balanced(const io::Table& history, const std::string& joule) {
  const auto at = [&](const char* name, std::size_t row) {
    return history.column(name + joule).at(row);
  };
  for (std::size_t row = 0; row < history.rows(); ++row) {
    double spent = at("kinetic", row) - at("kinetic", 0) + at("strain", row) - at("strain", 0);
    for (const char* loss : {"plastic_dissipation", "damping", "wall_friction", "scheme_loss"})
      spent += at(loss, row);
    const double largest = std::max(at("kinetic", 0), at("gravity_work", history.rows() - 1));
    EXPECT_NEAR(at("gravity_work", row), spent, 1e-12 * largest) << "row " << row;
    EXPECT_NEAR(at("gravity_work", row), at("gravitational", 0) - at("gravitational", row),
                1e-12 * at("gravitational", 0))
        << "row " << row;
  }
}

TEST_F(FinishedRun, WritesASeriesAHistoryAndARecordThatAgree) {
  const Result result = scarp({"run", "block.toml", "--out", "out"});
  expect_success(result); // no progress line: this is no terminal
  EXPECT_NE(result.out.find("400 points in 100 of 450 cells"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("end time at 0.1 s"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("  fields          all 12\n"), std::string::npos) << result.out;
  EXPECT_EQ(names_in(*this / "out"),
            (std::vector<std::string>{"block.pvd", "block_000000.vtp", "block_000001.vtp",
                                      "block_000002.vtp", "block_000003.vtp", "block_000004.vtp",
                                      "block_000005.vtp", "history.csv", "run.json"}));

  const auto record = nlohmann::json::parse(content(*this / "out/run.json"));
  EXPECT_EQ(record.at("program"), "scarp");
  EXPECT_EQ(record.at("ended"), "end time");
  EXPECT_EQ(record.at("points"), 400);
  EXPECT_EQ(record.at("cells"), 450);
  EXPECT_EQ(record.at("frames"), 6);
  EXPECT_EQ(record.at("stop_time_s"), 0.1);
  EXPECT_EQ(record.at("scene").at("title"), "A block of rods is let go");
  EXPECT_FALSE(record.contains("failure"));
  EXPECT_LE(record.at("shortest_step_s"), record.at("longest_step_s"));

  const io::SeriesReader series(*this / "out");
  ASSERT_EQ(series.size(), 6U);
  const double area = 0.1 * 0.1; // m2
  for (std::size_t i = 0; i < series.size(); ++i) {
    const io::Frame frame = series.read(i);
    EXPECT_EQ(frame.time, 0.02 * static_cast<double>(i));
    EXPECT_EQ(series.time(i), frame.time);
    EXPECT_EQ(frame.size(), 400U);
    EXPECT_EQ(frame.dimension, 2);
    EXPECT_EQ(frame.cell_size, 0.01);
    double initial = 0.0;
    double mass = 0.0;
    for (std::size_t p = 0; p < frame.size(); ++p) {
      initial += frame.column("initial_volume").values[p];
      mass += frame.column("density").values[p] * frame.column("volume").values[p];
    }
    EXPECT_NEAR(initial, area, 1e-12 * area);
    EXPECT_NEAR(mass, 2650.0 * area, 1e-9 * 2650.0 * area);
  }
  EXPECT_EQ(series.read(0).step, 0);
  EXPECT_EQ(series.read(5).step, record.at("steps").get<long>());

  const io::Table history = io::read_table(*this / "out/history.csv");
  // A row at the start and one at the first step after every tenth of a frame's interval.
  EXPECT_EQ(history.rows(), 51U);
  EXPECT_TRUE(std::ranges::is_sorted(history.column("time_s")));
  EXPECT_EQ(history.column("time_s").back(), 0.1);
  EXPECT_EQ(history.column("step").back(), record.at("steps").get<double>());
  expect_balanced(history, "_J_per_m");
  EXPECT_NEAR(history.column("kinetic_J_per_m").back(),
              record.at("energies_J_per_m").at("kinetic").get<double>(), 1e-12);

  // The front is that of the last frame, and the pile has spread and sunk.
  const io::Frame last = series.read(5);
  double front = 0.0;
  for (std::size_t p = 0; p < last.size(); ++p) front = std::max(front, last.position[3 * p]);
  EXPECT_EQ(history.column("front_x_m").back(), front);
  EXPECT_GT(front, 0.1);
  EXPECT_GT(history.column("gravity_work_J_per_m").back(), 0.0);
}

TEST_F(FinishedRun, BalancesEnergyWithEveryLossThereIs) {
  expect_success(scarp({"run", "block.toml", "--out", "out", "--set", "method.local_damping=0.05",
                        "--set", "walls.z_lower={kind='friction',coefficient=0.3}", "--set",
                        "region.block.velocity_m_s=[0.2,0]"}));
  const io::Table history = io::read_table(*this / "out/history.csv");
  expect_balanced(history, "_J_per_m");
  for (const char* loss :
       {"plastic_dissipation_J_per_m", "damping_J_per_m", "wall_friction_J_per_m"})
    EXPECT_GT(history.column(loss).back(), 0.0) << loss;
}

TEST_F(FinishedRun, IsTheSameToTheBitForAnyNumberOfThreads) {
  for (const char* threads : {"1", "2"})
    expect_success(scarp({"run", "block.toml", "--out", threads, "--threads", threads}));
  const std::vector<std::string> names = names_in(*this / "1");
  EXPECT_EQ(names, names_in(*this / "2"));
  EXPECT_EQ(names.size(), 9U);
  for (const std::string& name : names) {
    if (name == "run.json") continue; // it tells the time and the threads the run took
    EXPECT_TRUE(content(*this / "1" / name) == content(*this / "2" / name)) << name;
  }
  EXPECT_EQ(nlohmann::json::parse(content(*this / "1/run.json")).at("threads"), 1);
  EXPECT_EQ(nlohmann::json::parse(content(*this / "2/run.json")).at("threads"), 2);
}

/// The block stands from the start, its stress said in the plan; without cohesion it cannot.
TEST_F(FinishedRun, BeginsWithTheStressOfAStaticEquilibrium) {
  const std::vector<std::string> held = {"block.toml", "--set", "method.initial_stress=static",
                                         "--set", "material.rods.cohesion_Pa=1e4"};
  const auto with = [&](std::vector<std::string> words, std::vector<std::string> more) {
    words.insert(words.end(), held.begin(), held.end());
    words.insert(words.end(), more.begin(), more.end());
    return scarp(words);
  };
  const Result info = with({"info"}, {});
  expect_success(info);
  EXPECT_NE(info.out.find("  initial stress  static equilibrium, "), std::string::npos) << info.out;

  expect_success(with({"run"}, {"--out", "out"}));
  const auto record = nlohmann::json::parse(content(*this / "out/run.json"));
  EXPECT_TRUE(record.at("plan").at("initial stress").get<std::string>().starts_with("static"));
  const io::Table history = io::read_table(*this / "out/history.csv");
  const double scale = history.column("gravitational_J_per_m").front();
  EXPECT_LT(history.column("kinetic_J_per_m").back(), 1e-12 * scale);
  const auto& strain = history.column("strain_J_per_m");
  EXPECT_GT(strain.front(), 0.0);
  EXPECT_NEAR(strain.back(), strain.front(), 1e-9 * strain.front());
  EXPECT_NEAR(history.column("scheme_loss_J_per_m").back(), 0.0, 1e-9 * strain.front());

  expect_complaint(
      scarp({"run", "block.toml", "--out", "none", "--set", "method.initial_stress=static"}), 2,
      {"method.initial_stress", "the body fails", "[[stage]]"});
}

TEST_F(FinishedRun, InThreeDimensionsWritesJoules) {
  std::string text = small_scene;
  text.replace(text.find("[grid]"), 6, "[grid]\ndimension = 3");
  text.replace(text.find("[0, 0]"), 6, "[0, 0, 0]");
  text.replace(text.find("[0.3, 0.15]"), 11, "[0.3, 0.02, 0.15]");
  text.replace(text.find("[[0, 0], [0.1, 0.1]]"), 20, "[[0, 0, 0], [0.05, 0.02, 0.05]]");
  write_scene(text);
  expect_success(scarp({"run", "block.toml", "--out", "out", "--set", "time.end_s=0.02"}));
  const io::Table history = io::read_table(*this / "out/history.csv");
  expect_balanced(history, "_J");
  const io::Frame last = io::SeriesReader(*this / "out").read(1);
  EXPECT_EQ(last.dimension, 3);
  EXPECT_EQ(last.size(), 10U * 4U * 10U);
}

/// Nothing of a longer run before it stays in the series.
TEST_F(FinishedRun, ReplacesAnOlderRun) {
  expect_success(scarp({"run", "block.toml", "--out", "out"}));
  expect_success(scarp({"run", "block.toml", "--out", "out", "--set", "time.end_s=0.04"}));
  EXPECT_EQ(names_in(*this / "out"),
            (std::vector<std::string>{"block.pvd", "block_000000.vtp", "block_000001.vtp",
                                      "block_000002.vtp", "history.csv", "run.json"}));
  const io::SeriesReader series(*this / "out");
  EXPECT_EQ(series.size(), 3U);
  EXPECT_EQ(io::read_table(*this / "out/history.csv").column("time_s").back(), 0.04);
}

TEST_F(FinishedRun, FollowsMonitorsAndWritesOnlyTheFieldsAskedFor) {
  write_scene(std::string(small_scene) + "\n[[monitor]]\nname = \"toe\"\nposition_m = [0.1, 0]\n"
                                         "\n[output]\nfields = [\"velocity\", \"volume\"]\n");
  expect_success(scarp({"run", "block.toml", "--out", "out"}));
  const io::Frame last = io::SeriesReader(*this / "out").read(5);
  ASSERT_EQ(last.columns.size(), 2U);
  const io::Table history = io::read_table(*this / "out/history.csv");
  EXPECT_EQ(history.column("toe_x_m").front(), 0.0975);
  EXPECT_EQ(history.column("toe_z_m").front(), 0.0025);
  const std::size_t toe = 19; // of 20 points in the lowest row
  EXPECT_EQ(history.column("toe_x_m").back(), last.position[3 * toe]);
  EXPECT_EQ(history.column("toe_vz_m_s").back(), last.column("velocity").values[3 * toe + 2]);
}

} // namespace scarp::test
