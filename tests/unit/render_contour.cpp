#include "render/contour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace scarp::render {

namespace {

NodeField sampled(std::size_t nodes, double h, const std::function<double(double, double)>& f) {
  NodeField field = {{0.0, 0.0}, h, nodes, nodes, std::vector<double>(nodes * nodes)};
  for (std::size_t k = 0; k < nodes; ++k)
    for (std::size_t i = 0; i < nodes; ++i) field.at(i, k) = f(field.x(i), field.z(k));
  return field;
}

double area(const Polyline& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * twice;
}

} // namespace

TEST(ContourLines, AStraightLineRunsFromSideToSide) {
  const NodeField field = sampled(11, 0.1, [](double x, double z) { return x + 2.0 * z; });
  const std::vector<Polyline> lines = contour_lines(field, 1.03);
  ASSERT_EQ(lines.size(), 1U);
  for (const Point point : lines[0]) EXPECT_NEAR(point.x + 2.0 * point.y, 1.03, 1e-12);
  EXPECT_NEAR(lines[0].front().x + lines[0].back().x, 1.0, 1e-12);
}

TEST(ContourLines, ACircleIsClosedWithHighValuesOnTheLeft) {
  const NodeField field =
      sampled(41, 0.05, [](double x, double z) { return 1.0 - std::hypot(x - 1.0, z - 1.0); });
  const std::vector<Polyline> lines = contour_lines(field, 0.37);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front().x, lines[0].back().x);
  EXPECT_EQ(lines[0].front().y, lines[0].back().y);
  const double circle = 3.141592653589793 * 0.63 * 0.63;
  EXPECT_NEAR(area(lines[0]), circle, 0.005 * circle);
}

TEST(ContourLines, ASaddleIsCutByItsMean) {
  NodeField field = {{0.0, 0.0}, 1.0, 2, 2, {1.0, 0.0, 0.0, 1.0}};
  EXPECT_EQ(contour_lines(field, 0.6).size(), 2U);
  EXPECT_EQ(contour_lines(field, 0.4).size(), 2U);
  // Joined high corners leave the low corner (1, 0) alone: its line stays near it.
  for (const Polyline& line : contour_lines(field, 0.4)) {
    const double side = line[0].x + line[1].x > 1.0 ? 1.0 : 0.0;
    for (const Point point : line) EXPECT_LE(std::abs(point.x - side), 0.4 + 1e-12);
  }
}

TEST(FilledBands, TileTheBody) {
  const auto body_value = [](double x, double z) { return 1.0 - 0.5 * (x + z); };
  const NodeField body = sampled(21, 0.1, body_value); // at least 0.5 where x + z <= 1: area 0.5
  const NodeField field = sampled(21, 0.1, [](double x, double) { return x; });
  std::map<std::size_t, double> areas;
  filled_bands(body, field, {0.0, 0.25, 0.5, 0.6}, [&](const Polyline& polygon, std::size_t band) {
    EXPECT_GT(area(polygon), -1e-15);
    areas[band] += area(polygon);
  });
  EXPECT_NEAR(areas[0], 0.5 - 0.5 * 0.75 * 0.75, 1e-12);
  EXPECT_NEAR(areas[1], 0.5 * 0.75 * 0.75 - 0.5 * 0.5 * 0.5, 1e-12);
  EXPECT_NEAR(areas[2], 0.5 * 0.5 * 0.5, 1e-12); // with all beyond
}

TEST(Refined, IsTheSameBilinearField) {
  const NodeField field = sampled(5, 1.0, [](double x, double z) { return x * z + 2.0 * z; });
  const NodeField fine = refined(field, 4);
  EXPECT_EQ(fine.nodes_x, 17U);
  for (std::size_t k = 0; k < fine.nodes_z; ++k)
    for (std::size_t i = 0; i < fine.nodes_x; ++i)
      EXPECT_NEAR(fine.at(i, k), fine.x(i) * fine.z(k) + 2.0 * fine.z(k), 1e-12);
}

TEST(Refined, SmoothKeepsConstantsAndStaysBetweenTheNodes) {
  for (const std::size_t times : {2UL, 4UL}) {
    const NodeField ones =
        refined_smooth(sampled(5, 1.0, [](double, double) { return 1.0; }), times);
    for (const double value : ones.values) EXPECT_NEAR(value, 1.0, 1e-14);
    const NodeField step = refined_smooth(
        sampled(9, 1.0, [](double x, double) { return x > 3.5 ? 1.0 : 0.0; }), times);
    for (const double value : step.values) EXPECT_TRUE(value >= 0.0 && value <= 1.0);
  }
}

} // namespace scarp::render
