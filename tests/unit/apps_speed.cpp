// The speed bench: its operation counts, its scene, its ratios and what it writes.
#include "apps/bench/flops.hpp"
#include "apps/bench/speed.hpp"
#include "tests/support/fresh_directory.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace scarp;
using namespace scarp::bench;

namespace {

SpeedRow row(int dimension, ShapeFunctions shape, int threads, std::size_t points, double rate) {
  SpeedRow one;
  one.dimension = dimension;
  one.how.method.shape = shape;
  one.threads = threads;
  one.points = points;
  one.rate = rate;
  one.alone = 2.0 * rate;
  one.memory = 190.0;
  return one;
}

const SpeedRatio* find(const std::vector<SpeedRatio>& ratios, const std::string& words) {
  for (const SpeedRatio& ratio : ratios)
    if (ratio.name.find(words) != std::string::npos) return &ratio;
  return nullptr;
}

SpeedPlan tiny_plan() {
  SpeedPlan plan = speed_plan(Effort::quick);
  plan.threads = {1};
  plan.methods.resize(2);
  plan.methods[1].most_points = {1e300, 1.0};
  plan.sizes = {{collapse_of(2, 500.0), 5, 9, 1}, {collapse_of(3, 500.0), 5, 9, 1}};
  plan.largest_frame = 500.0;
  return plan;
}

} // namespace

TEST(SpeedFlops, FunctionsAlongAnAxisAreCountedRight) {
  for (const ShapeFunctions shape : {ShapeFunctions::linear, ShapeFunctions::bspline}) {
    const AxisFlops one = axis_flops(shape);
    EXPECT_EQ(one.stated, one.counted);
  }
}

/// Linear functions in plane strain, 4 nodes: by hand, one after the other.
TEST(SpeedFlops, ScatterByHand) {
  const StepCost cost = step_cost(2, ShapeFunctions::linear, VelocityTransfer::flip, 2, 8);
  const int place = 2 * 3;           // (x - lower) / h - corner
  const int functions = 2;           // 1 - xi
  const int of_point = 2 + 3;        // m v; V0 tau_xx, tau_zz, tau_xz
  const int value = 2 + 2 * 4;       // its product with w_z; with w_x, and added
  const int force = 2 * (2 + 2 * 4); // two products with w_z and its slope; with w_x and its slope
  const int of_cell = (2 + 2 + 2) * 2; // m, V0, m v, f with the next cell's: of 4 points
  EXPECT_EQ(cost.flops_of(Phase::scatter),
            place + functions + of_point + 4 * value + 2 * force + of_cell / 4);
  // (1 + 2 * 2) * 2 sums of tiles, 1 / m, fraction, v, gravity, forces, dv; 4 points a node
  EXPECT_EQ(cost.flops_of(Phase::nodes), (10 + 2 + 2 + 2 + 8 + 2) / 4.0);
}

TEST(SpeedFlops, GrowWithDimensionReachAndTransfer) {
  using enum ShapeFunctions;
  using enum VelocityTransfer;
  const auto all = [](int dimension, ShapeFunctions shape, VelocityTransfer transfer) {
    return step_cost(dimension, shape, transfer, 2, 8).all_flops();
  };
  EXPECT_GT(all(2, linear, flip), 250.0);
  EXPECT_LT(all(2, linear, flip), 500.0);
  EXPECT_GT(all(2, bspline, flip), all(2, linear, flip));
  EXPECT_GT(all(2, bspline, apic), all(2, bspline, flip));
  EXPECT_GT(all(3, linear, flip), 2.0 * all(2, linear, flip));
  EXPECT_THROW(step_cost(2, gimp, flip, 2, 8), std::invalid_argument);
  // Floats move half the bytes but for ids and materials.
  const double two = step_cost(2, linear, flip, 2, 8).all_bytes();
  const double one = step_cost(2, linear, flip, 2, 4).all_bytes();
  EXPECT_GT(one, 0.5 * two);
  EXPECT_LT(one, 0.6 * two);
}

TEST(SpeedScene, YieldsAndKeepsItsSize) {
  for (const int dimension : {2, 3}) {
    const CollapseSize size = collapse_of(dimension, 3000.0);
    const auto simulation = begin_collapse(size, {}, collapse_start(size));
    EXPECT_EQ(simulation->points(), size.points());
    EXPECT_NEAR(static_cast<double>(size.points()), 3000.0, 1000.0);
    for (int k = 0; k < 10; ++k) simulation->step(1.0);
    EXPECT_GT(yielded_part(*simulation), 0.9);
  }
}

TEST(SpeedRatios, AreOfTheRightRows) {
  const std::vector<SpeedRow> rows = {row(2, ShapeFunctions::linear, 1, 10000, 99e6),
                                      row(2, ShapeFunctions::linear, 1, 100352, 50e6),
                                      row(2, ShapeFunctions::linear, 2, 100352, 90e6),
                                      row(2, ShapeFunctions::bspline, 1, 100352, 25e6),
                                      row(2, ShapeFunctions::linear, 1, 9999392, 40e6),
                                      row(3, ShapeFunctions::linear, 1, 93312, 20e6)};
  const std::vector<SpeedRatio> ratios = speed_ratios(rows);
  const auto value = [&](const char* words) {
    const SpeedRatio* one = find(ratios, words);
    return one ? one->value : std::nan("");
  };
  EXPECT_DOUBLE_EQ(value("plane strain, linear, 1 thread"), 50.0);
  EXPECT_DOUBLE_EQ(value("plane strain: cost of B-splines"), 2.0);
  EXPECT_DOUBLE_EQ(value("plane strain, linear: 2 threads"), 1.8);
  EXPECT_DOUBLE_EQ(value("cost at 10⁷ over 10⁵"), 1.25);
  EXPECT_DOUBLE_EQ(value("plane strain, linear: memory"), 190.0);
  EXPECT_DOUBLE_EQ(find(ratios, "plane strain, linear, 1 thread")->alone, 100.0);
  EXPECT_EQ(find(ratios, "3-D: cost of B-splines"), nullptr) << "no such row";
  EXPECT_EQ(find(ratios, "plane strain, linear, 1 thread")->verdict(), "MISSED");
  EXPECT_EQ(find(ratios, "3-D, linear, 1 thread")->verdict(), "pass");
  EXPECT_EQ(find(ratios, "plane strain: cost of B-splines")->verdict(), "pass");
  EXPECT_EQ(find(ratios, "cost of 3-D over plane strain")->verdict(), "-");
}

TEST(SpeedPlan, HasTheSizesOfTheContract) {
  const SpeedPlan full = speed_plan(Effort::full);
  ASSERT_EQ(full.sizes.size(), 7U);
  EXPECT_NEAR(static_cast<double>(full.sizes[3].size.points()), 1e7, 1e5);
  EXPECT_EQ(full.threads.front(), 1);
  for (const SpeedSize& one : full.sizes) {
    EXPECT_GE(one.repetitions, 3);
    // A step is 0.3 of a cell over a wave speed of 21 m/s; half a metre a second and what gravity
    // adds take longer than this to the end of the grid.
    const long steps = one.warm_up + one.steps * one.repetitions * 2;
    EXPECT_LT(static_cast<double>(steps) * 0.3 * 0.2 / one.size.cells_high / 21.0, 0.12);
  }
  EXPECT_EQ(speed_plan(Effort::quick).sizes.size(), 2U) << "one a dimension";
}

TEST(Speed, MeasuresAndWrites) {
  const std::filesystem::path out = test::fresh_directory();
  const int threads = omp_get_max_threads();
  const SpeedReport report = measure_speed(tiny_plan(), out, {});
  EXPECT_EQ(omp_get_max_threads(), threads);
  ASSERT_EQ(report.rows.size(), 3U) << "one method is too slow in 3-D";
  ASSERT_EQ(report.skipped.size(), 1U);
  EXPECT_NE(report.skipped.front().find("3-D, linear"), std::string::npos);
  for (const SpeedRow& one : report.rows) {
    EXPECT_GT(one.rate, 0.0);
    EXPECT_GT(one.alone, 0.3 * one.rate);
    EXPECT_GT(one.memory, 100.0);
    EXPECT_GT(one.part_of_flops, 0.0);
    EXPECT_LT(one.part_of_flops, 1.0);
    double step = 0.0; // s a point, of all phases of the one repetition
    for (const double rate : one.phase_rate) {
      EXPECT_GE(rate, 0.999 * one.rate);
      step += 1.0 / rate;
    }
    EXPECT_LE(step * one.rate, 1.0 + 1e-9);
    EXPECT_GT(step * one.rate, 0.5) << "phases make up the step";
  }
  write_speed(out, report);
  std::ifstream in(out / "speed.json");
  const auto record = nlohmann::json::parse(in);
  ASSERT_TRUE(record.is_array());
  ASSERT_EQ(record.size(), report.rows.size());
  for (const char* key : {"scene", "dim", "shape", "precision", "threads", "points",
                          "point_steps_per_s", "fraction_of_peak_flops", "bytes_per_point"})
    EXPECT_TRUE(record[0].contains(key)) << key;
  for (const char* phase : {"sort", "P2G", "grid", "G2P", "remap", "stress", "output"})
    EXPECT_TRUE(record[0].at("phases").contains(phase)) << phase;
  for (const char* file : {"speed.csv", "machine.json", "speed.png"})
    EXPECT_TRUE(std::filesystem::exists(out / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(out / "frame_for_timing"));
}

TEST(Roofline, IsPlausible) {
  const Roofline one = measure_roofline(1, this_machine(), true);
  EXPECT_GT(one.flops_double, 1e8);
  EXPECT_GT(one.flops_single, one.flops_double);
  EXPECT_GT(one.memory_bandwidth, 1e8);
}
