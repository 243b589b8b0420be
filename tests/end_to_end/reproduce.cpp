// scarp reproduce: the published case in coarse cells (3 200 points), measured and drawn.
#include "tests/end_to_end/program.hpp"

#include "io/series.hpp"
#include "io/table.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace scarp::test {

using Reproduce = EndToEnd;

/// One run for all of it.  The bounds are one-sided where a better program may only come closer.
TEST_F(Reproduce, Bui2008IsNearTheExperiment) {
  const Result result = scarp({"reproduce", "bui2008", "--cell", "0.005", "--out", "out"});
  expect_success(result);
  for (const char* row :
       {"free surface", "failure line", "front of the body", "at rest after", "points thrown off"})
    EXPECT_NE(result.out.find(row), std::string::npos) << row;

  const auto summary = nlohmann::json::parse(content(*this / "out/summary.json"));
  for (const char* key : {"points", "steps", "wall_s", "frame_wall_s", "surface_rms_mm",
                          "surface_max_mm", "failure_rms_mm", "failure_max_mm",
                          "slightly_moved_rms_mm", "runout_m", "experiment_runout_m", "stop_time_s",
                          "max_abs_volume_ratio_error", "thrown_points", "scheme_loss_part"}) {
    ASSERT_TRUE(summary.contains(key)) << key;
    EXPECT_TRUE(summary.at(key).is_number() && std::isfinite(summary.at(key).get<double>())) << key;
  }
  const auto value = [&](const char* key) { return summary.at(key).get<double>(); };
  EXPECT_EQ(value("points"), 3200);
  EXPECT_EQ(summary.at("at_rest"), true);
  EXPECT_LE(value("surface_rms_mm"), 4.0);
  EXPECT_LE(value("surface_rms_mm"), value("surface_max_mm"));
  EXPECT_LE(value("failure_rms_mm"), 10.0); // two cells; measured 4.5
  EXPECT_NE(value("slightly_moved_rms_mm"), value("failure_rms_mm"));
  // In these coarse cells lone rods of the front slide on the base, a chance that follows from
  // rounding alone: 0 to 3 of 3200 in 48 runs that differ by the order of their sums, 0 in 33.
  EXPECT_LE(value("thrown_points"), 3);
  EXPECT_NEAR(value("runout_m"), value("experiment_runout_m"), 0.03); // measured + 13 mm

  // PIC takes a part of the velocity every step; measured 6.7 % of gravity's work in these cells.
  EXPECT_GT(value("scheme_loss_part"), 0.0);
  EXPECT_LT(value("scheme_loss_part"), 0.08);
  const auto& energies = summary.at("energies_J_per_m");
  const double work = energies.at("gravity_work").get<double>();
  EXPECT_NEAR(energies.at("scheme_loss").get<double>(), value("scheme_loss_part") * work,
              1e-12 * work);
  EXPECT_LT(energies.at("kinetic").get<double>(), 1e-3 * work);

  const io::SeriesReader series(*this / "out");
  EXPECT_EQ(series.name(), "bui2008");
  EXPECT_EQ(series.time(series.size() - 1), value("stop_time_s"));
  for (const char* picture : {"figure2_model.png", "figure3_plastic_strain.png",
                              "figure5_validation.png", "energies.png", "frame_last.png"}) {
    const Size size = png_size(*this / "out" / picture);
    EXPECT_GE(size.width, 400U) << picture;
    EXPECT_GE(size.height, 200U) << picture;
  }
  EXPECT_EQ(png_size(*this / "out/frame_last.png"), (Size{1920, 1080}));
}

/// What resists the more the faster it is sheared falls less fast.
TEST_F(Reproduce, Bui2008WithRateHasLessKineticEnergy) {
  const auto peak = [&](const std::string& model) {
    expect_success(
        scarp({"reproduce", "bui2008", "--cell", "0.01", "--model", model, "--out", model}));
    const auto summary = nlohmann::json::parse(content(*this / model / "summary.json"));
    EXPECT_EQ(summary.at("model"), model);
    const io::Table history = io::read_table(*this / model / "history.csv");
    return std::ranges::max(history.column("kinetic_J_per_m"));
  };
  const double of_published = peak("published"), of_disks = peak("disks");
  EXPECT_LT(of_disks, of_published);
  EXPECT_LT(peak("inertial"), of_disks);
}

TEST_F(Reproduce, RefusesCellsThatDoNotFillTheGrid) {
  expect_complaint(scarp({"reproduce", "bui2008", "--cell", "0.003", "--out", "out"}), 2,
                   {"grid.upper_m", "0.003"});
  EXPECT_FALSE(fs::exists(*this / "out"));
}

} // namespace scarp::test
