#include "render/body.hpp"
#include "tests/support/hand_made_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace scarp::render {

using test::add_column;
using test::add_point;
using test::empty_frame;
using test::rectangle;

namespace {

constexpr double exact = 1e-12;
constexpr double h = 0.1;

/// Displacement u(x, z) in x of every point; positions move along.
void displace(io::Frame& frame, const std::function<double(double, double)>& u) {
  std::vector<double> displacement;
  for (std::size_t p = 0; p < frame.size(); ++p) {
    const double moved = u(frame.position[3 * p], frame.position[3 * p + 2]);
    frame.position[3 * p] += moved;
    displacement.insert(displacement.end(), {moved, 0.0, 0.0});
  }
  add_column(frame, "displacement", 3, std::move(displacement));
}

} // namespace

TEST(VolumeFraction, IsOneInsideAlsoAtTheGridsSides) {
  const NodeField fraction = volume_fraction(rectangle(h, 1.0, 0.5));
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(fraction.at(i, k), 1.0, exact);
  EXPECT_NEAR(fraction.at(10, 2), 0.5, exact);
  EXPECT_NEAR(fraction.at(11, 2), 0.0, exact);
}

TEST(VolumeFraction, FallsBackOnTheVolumes) {
  io::Frame frame = rectangle(h, 1.0, 0.5);
  frame.columns.front().name = "volume";
  EXPECT_NEAR(volume_fraction(frame).at(3, 3), 1.0, exact);
  frame.columns.front().name = "mass";
  EXPECT_THROW(volume_fraction(frame), std::runtime_error);
}

TEST(VolumeFraction, WantsPlaneStrain) {
  EXPECT_THROW(volume_fraction(test::heap()), std::invalid_argument);
}

TEST(FreeSurface, OfARectangleAtNodes) {
  const BodyShape body = measure_body(rectangle(h, 1.0, 0.5));
  for (const double x : {0.0, 0.1, 0.55, 0.87}) EXPECT_NEAR(body.height_at(x).value(), 0.5, 1e-9);
  EXPECT_NEAR(body.run_out, 1.0, 1e-9);
  EXPECT_FALSE(body.height_at(1.15));
  EXPECT_FALSE(body.height_at(-0.01));
}

TEST(FreeSurface, OfARectangleMidCell) {
  const BodyShape body = measure_body(rectangle(h, 0.95, 0.45));
  EXPECT_NEAR(body.height_at(0.3).value(), 0.45, 1e-9);
  EXPECT_NEAR(body.run_out, 0.95, 1e-9);
}

TEST(FreeSurface, OfATriangle) {
  io::Frame frame = empty_frame(h, 2.0, 2.0);
  const double spacing = 0.5 * h;
  test::fill(frame, [&](double x, double z) { return x + z < 1.0 - 0.5 * spacing; });
  for (double x = 0.5 * spacing; x < 1.0; x += spacing) { // halves of squares on the face
    const double z = 1.0 - x;
    add_point(frame, x - spacing / 6.0, z - spacing / 6.0, 0.5 * spacing * spacing);
  }
  const BodyShape body = measure_body(frame);
  for (double x = 0.2; x < 0.85; x += 0.05)
    EXPECT_NEAR(body.height_at(x).value(), 1.0 - x, 0.05 * h) << "x = " << x;
}

TEST(FreeSurface, ScansFromTheTop) {
  io::Frame frame = empty_frame(h, 1.0, 1.0);
  test::fill(frame, [](double, double z) { return z < 0.2 || (z > 0.5 && z < 0.8); });
  EXPECT_NEAR(measure_body(frame).height_at(0.5).value(), 0.8, 1e-9);
}

TEST(FreeSurface, NoBodyHasNoHeight) {
  const BodyShape body = measure_body(empty_frame(h, 1.0, 1.0));
  EXPECT_FALSE(body.height_at(0.5));
  EXPECT_EQ(body.run_out, 0.0);
  EXPECT_TRUE(body.free_surface.empty());
}

TEST(FreeSurface, AFullGridReachesItsEnds) {
  io::Frame frame = empty_frame(h, 1.0, 1.0);
  test::fill(frame, [](double, double) { return true; });
  const BodyShape body = measure_body(frame);
  EXPECT_NEAR(body.height_at(0.5).value(), 1.0, exact);
  EXPECT_NEAR(body.run_out, 1.0, exact);
}

TEST(SurfaceError, OverTheRowsOfTheExperiment) {
  const BodyShape body = measure_body(rectangle(h, 1.0, 0.5));
  const io::Table experiment = {{"x_m", "z_m"}, {{0.2, 0.4, 1.5}, {0.5, 0.47, 0.04}}};
  const CurveError error = surface_error(body, experiment); // 0, 0.03 and, without a body, -0.04
  EXPECT_EQ(error.n, 3U);
  EXPECT_NEAR(error.max, 0.04, 1e-9);
  EXPECT_NEAR(error.rms, std::sqrt((0.0009 + 0.0016) / 3.0), 1e-9);
}

TEST(FailureLine, LiesWhereThePointsMovedOneMillimetre) {
  io::Frame frame = rectangle(0.01, 0.2, 0.1);
  // |u| is linear in z and comes to 1 mm on z = 0.08 - 0.3 x.
  displace(frame,
           [](double x, double z) { return std::max(0.0, 1e-3 + 0.1 * (z - 0.08 + 0.3 * x)); });
  const FailureLine line = failure_line(frame);
  ASSERT_EQ(line.x.size(), 40U);
  for (std::size_t i = 0; i < line.x.size(); ++i)
    EXPECT_NEAR(line.z[i], 0.08 - 0.3 * line.x[i], 1e-9);
  EXPECT_NEAR(line.z_at(0.05), 0.065, 1e-9);
  const io::Table experiment = {{"x_m", "z_m"}, {{0.05, 0.1}, {0.065, 0.052}}};
  const CurveError error = failure_error(line, experiment);
  EXPECT_NEAR(error.max, 0.002, 1e-9);
  EXPECT_NEAR(error.rms, std::sqrt(2e-6), 1e-9);
}

TEST(FailureLine, EndsAtTheTopAndTheBottomOfTheLattice) {
  io::Frame frame = rectangle(0.01, 0.2, 0.1);
  displace(frame, [](double x, double) { return x > 0.1 ? 0.05 : 0.0; });
  const FailureLine line = failure_line(frame);
  EXPECT_NEAR(line.z_at(0.05), 0.1, exact);
  EXPECT_NEAR(line.z_at(0.15), 0.0, exact);
  EXPECT_NEAR(line.z_at(-1.0), 0.1, exact);
  EXPECT_NEAR(line.z_at(9.0), 0.0, exact);
}

TEST(FailureLine, NeedsDisplacements) {
  EXPECT_THROW(failure_line(rectangle(h, 1.0, 0.5)), std::runtime_error);
}

TEST(ThrownOff, MoreThanTwoCellsFromTheBody) {
  io::Frame frame = rectangle(h, 1.0, 0.5);
  EXPECT_TRUE(thrown_off(frame).empty());
  const std::size_t first = frame.size();
  add_point(frame, 1.05, 0.05, 1e-3); // the next cell: part of the body, which now reaches x = 1.1
  add_point(frame, 1.25, 0.05, 1e-3); // two cells on
  add_point(frame, 0.35, 0.75, 1e-3); // three cells above
  add_point(frame, 0.35, 0.65, 1e-3); // two cells above
  add_point(frame, -0.01, 0.1, 1e-3); // left the grid
  add_point(frame, NAN, 0.1, 1e-3);
  EXPECT_EQ(thrown_off(frame), (std::vector<std::size_t>{first + 2, first + 4, first + 5}));
}

TEST(ThrownOff, AlsoIn3D) {
  io::Frame frame = test::heap();
  EXPECT_TRUE(thrown_off(frame).empty());
  frame.position.insert(frame.position.end(), {1.95, 0.95, 0.95});
  EXPECT_EQ(thrown_off(frame), (std::vector<std::size_t>{frame.size() - 1}));
}

TEST(VolumeRatio, LargestDeparture) {
  io::Frame frame = empty_frame(h, 1.0, 1.0);
  add_point(frame, 0.1, 0.1, 2.0);
  add_point(frame, 0.2, 0.1, 2.0);
  EXPECT_FALSE(max_abs_volume_ratio_error(frame));
  add_column(frame, "volume", 1, {2.2, 1.7});
  EXPECT_NEAR(max_abs_volume_ratio_error(frame).value(), 0.15, exact);
}

} // namespace scarp::render
