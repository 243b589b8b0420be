// Runs that do not come to their end: what they leave can be read, and what they say is true.
#include "tests/end_to_end/program.hpp"

#include "io/series.hpp"
#include "io/table.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <thread>

#include <sched.h>
#include <sys/mount.h>

namespace scarp::test {

using FailedRun = EndToEnd;

/// Every frame that the .pvd lists, with all its columns.
void expect_readable(const io::SeriesReader& series, std::size_t points) {
  for (std::size_t i = 0; i < series.size(); ++i) {
    const io::Frame frame = series.read(i); // throws, with the reason, what cannot be read
    EXPECT_EQ(frame.size(), points);
    EXPECT_EQ(frame.time, series.time(i));
    EXPECT_EQ(frame.columns.size(), 12U);
  }
}

/// The block slides towards a free side 2 cm away.
TEST_F(FailedRun, OfAPointThatLeavesTheGridSaysWhereAndKeepsTheLastState) {
  const Result result =
      scarp({"run", "block.toml", "--out", "out", "--set", "grid.upper_m=[0.12,0.15]", "--set",
             "region.block.velocity_m_s=[1,0]"});
  expect_complaint(result, 1,
                   {"the run failed: step ", ", time ", " s: point ", " at x = 0.11",
                    ", z = ", "leaves the grid", "try: "});

  const auto record = nlohmann::json::parse(content(*this / "out/run.json"));
  EXPECT_EQ(record.at("ended"), "failed");
  EXPECT_EQ("scarp: the run failed: " + record.at("failure").get<std::string>() + "\n", result.err);

  const io::SeriesReader series(*this / "out");
  ASSERT_EQ(series.size(), record.at("frames").get<std::size_t>());
  expect_readable(series, 400);
  const io::Frame last = series.read(series.size() - 1);
  EXPECT_EQ(last.time, record.at("stop_time_s").get<double>());
  EXPECT_EQ(last.step, record.at("steps").get<long>());
  EXPECT_GT(last.time, series.time(series.size() - 2));
  // The point named is there, still inside the grid.
  const std::string said = record.at("failure");
  const std::size_t point = std::stoul(said.substr(said.find("point ") + 6));
  const double x = std::stod(said.substr(said.find("x = ") + 4));
  EXPECT_NEAR(last.position.at(3 * point), x, 1e-5 * x);
  EXPECT_LT(x, 0.12);
}

/// Frames come so fast that some of these runs are killed while they write one.
TEST_F(FailedRun, KilledLeavesASeriesThatLoads) {
  using std::chrono::steady_clock;
  for (int round = 0; round < 6; ++round) {
    const std::string out = "out" + std::to_string(round);
    Program program(directory_, {"run", "block.toml", "--out", out, "--set", "time.end_s=100",
                                 "--set", "time.output_interval_s=0.0002"});
    const fs::path awaited = *this / out / ("block_00000" + std::to_string(3 + round) + ".vtp");
    const auto deadline = steady_clock::now() + std::chrono::seconds(60);
    while (!fs::exists(awaited)) {
      ASSERT_LT(steady_clock::now(), deadline) << "no " << awaited.filename();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(700 * round)); // at another moment each
    program.kill();
    EXPECT_EQ(program.wait().signal, SIGKILL);

    const io::SeriesReader series(*this / out);
    EXPECT_GE(series.size(), static_cast<std::size_t>(3 + round));
    expect_readable(series, 400);
    // The history is as far as the frames, which are two steps apart.
    const io::Table history = io::read_table(*this / out / "history.csv");
    EXPECT_GE(history.column("time_s").back(), series.time(series.size() - 1) - 0.0002);
    EXPECT_FALSE(fs::exists(*this / out / "run.json"));
  }
}

/// A disk of 200 kB; the mount is this process's alone and goes with it.
TEST_F(FailedRun, OnAFullDiskSaysSoAndKeepsWhatIsWhole) {
  fs::create_directory(*this / "out");
  if (::unshare(CLONE_NEWNS) != 0 ||
      ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      ::mount("none", (*this / "out").c_str(), "tmpfs", 0, "size=200k") != 0)
    GTEST_SKIP() << "a small disk takes the right to mount one";
  expect_complaint(
      scarp({"run", "block.toml", "--out", "out", "--set", "time.output_interval_s=0.002"}), 1,
      {"out/", "No space left on device"});
  const io::SeriesReader series(*this / "out");
  EXPECT_GE(series.size(), 1U);
  EXPECT_LT(series.size(), 51U);
  expect_readable(series, 400);
  EXPECT_FALSE(fs::exists(*this / "out/run.json"));
  ::umount((*this / "out").c_str());
}

} // namespace scarp::test
