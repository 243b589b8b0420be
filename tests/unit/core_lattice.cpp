#include "core/error.hpp"
#include "core/first_places.hpp"
#include "core/lattice.hpp"
#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace scarp;
using namespace scarp::test;

namespace {

using Polygon = std::vector<Point2>;

const Polygon unit_square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// Cells of 0.5 m with 2 x 2 points: a lattice of 0.25 m.
Scene scene_of(const std::vector<Region>& regions) {
  Scene scene;
  scene.grid = grid_2d(0.5, {-1.0, -1.0}, {3.0, 3.0});
  scene.materials = {elastic("rock", 2000.0, 1e6, 0.3), elastic("ice", 900.0, 1e6, 0.3)};
  scene.regions = regions;
  return scene;
}

Region polygon_region(const std::string& name, const std::string& material,
                      const Polygon& polygon) {
  Region region;
  region.name = name;
  region.material = material;
  region.polygon = polygon;
  return region;
}

template <class Call> std::string setup_error(Call&& call) {
  try {
    call();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "no SetupError";
}

} // namespace

/// Triangle (0,0), (3,0), (0,6): area 3 * 6 / 2 = 9, centroid the mean of its corners.
TEST(Measure, Triangle) {
  const PolygonMeasure triangle = measure({{0, 0}, {3, 0}, {0, 6}});
  EXPECT_NEAR(triangle.area, 9.0, 1e-15);
  EXPECT_NEAR(triangle.centroid[0], 1.0, 1e-15);
  EXPECT_NEAR(triangle.centroid[1], 2.0, 1e-15);
}

TEST(Measure, ClockwiseIsNegativeWithTheSameCentroid) {
  const PolygonMeasure triangle = measure({{0, 6}, {3, 0}, {0, 0}});
  EXPECT_NEAR(triangle.area, -9.0, 1e-15);
  EXPECT_NEAR(triangle.centroid[0], 1.0, 1e-15);
  EXPECT_NEAR(triangle.centroid[1], 2.0, 1e-15);
}

/// An L of three unit squares with centres (0.5, 0.5), (1.5, 0.5), (0.5, 1.5): centroid (5/6, 5/6).
TEST(Measure, Concave) {
  const PolygonMeasure l = measure({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  EXPECT_NEAR(l.area, 3.0, 1e-15);
  EXPECT_NEAR(l.centroid[0], 5.0 / 6.0, 1e-15);
  EXPECT_NEAR(l.centroid[1], 5.0 / 6.0, 1e-15);
}

/// A micrometre square a kilometre away: coordinates are only known to 1e-13 m there, areas
/// relative to the origin would have no digit right.
TEST(Measure, SmallAndFarAway) {
  const double a = 0x1p-20, far = 1024.0; // exact in binary
  const PolygonMeasure square =
      measure({{far, far}, {far + a, far}, {far + a, far + a}, {far, far + a}});
  EXPECT_EQ(square.area, a * a);
  EXPECT_EQ(square.centroid[0], far + 0.5 * a);
}

TEST(Measure, NothingHasNoArea) {
  EXPECT_EQ(measure({}).area, 0.0);
  EXPECT_EQ(measure({{0, 0}, {1, 1}}).area, 0.0);
  EXPECT_EQ(measure({{0, 0}, {1, 1}, {2, 2}}).area, 0.0);
}

TEST(Clip, KeepsWhatIsInsideAndDropsWhatIsOutside) {
  EXPECT_EQ(clip(unit_square, {-1, -1}, {2, 2}), unit_square);
  EXPECT_NEAR(measure(clip(unit_square, {2, 0}, {3, 1})).area, 0.0, 0.0);
  EXPECT_NEAR(measure(clip(unit_square, {1, 0}, {2, 1})).area, 0.0, 0.0) << "they only touch";
}

/// A rectangle around a corner of the triangle x + z <= 1: the unit square's lower left half.
TEST(Clip, HalfASquare) {
  const Polygon big = {{-1, -1}, {2, -1}, {-1, 2}}; // x + z <= 1
  const PolygonMeasure half = measure(clip(big, {0, 0}, {1, 1}));
  EXPECT_NEAR(half.area, 0.5, 1e-15);
  EXPECT_NEAR(half.centroid[0], 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(half.centroid[1], 1.0 / 3.0, 1e-15);
}

/// A U whose two arms (each 1 x 2) the rectangle meets without its bottom:
/// two pieces, together 2 * 1 * 1.
TEST(Clip, ConcaveInTwoPieces) {
  const Polygon u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const PolygonMeasure arms = measure(clip(u, {0, 2}, {3, 3}));
  EXPECT_NEAR(arms.area, 2.0, 1e-15);
  EXPECT_NEAR(arms.centroid[0], 1.5, 1e-15);
  EXPECT_NEAR(arms.centroid[1], 2.5, 1e-15);
}

/// Cutting a polygon along a lattice loses nothing and counts nothing twice.
TEST(Clip, PiecesAddUpToTheWhole) {
  Random random(5);
  for (int sample = 0; sample < 50; ++sample) {
    Polygon star; // simple: its corners go round the centre
    for (int k = 0; k < 9; ++k) {
      const double angle = 2.0 * 3.14159265358979323846 * k / 9.0,
                   radius = random.between(0.5, 3.0);
      star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    double area = 0.0;
    Point2 moment = {0, 0};
    for (int i = -6; i < 6; ++i)
      for (int k = -6; k < 6; ++k) {
        const PolygonMeasure piece =
            measure(clip(star, {0.5 * i, 0.5 * k}, {0.5 * (i + 1), 0.5 * (k + 1)}));
        EXPECT_GE(piece.area, -1e-15);
        area += piece.area;
        for (std::size_t a = 0; a < 2; ++a) moment[a] += piece.area * piece.centroid[a];
      }
    const PolygonMeasure whole = measure(star);
    EXPECT_NEAR(area, whole.area, 1e-13);
    for (std::size_t a = 0; a < 2; ++a)
      EXPECT_NEAR(moment[a], whole.area * whole.centroid[a], 1e-13);
  }
}

/// A box of 2 m x 1 m on a lattice of 0.25 m: 8 x 4 points of 0.0625 m2, the first at (0.125,
/// 0.125), x running fastest.
TEST(FillRegions, Box) {
  const auto points =
      fill_regions<2>(scene_of({box("b", "rock", {0, 0}, {2, 1}, {3.0, 7.0, -4.0})}));
  ASSERT_EQ(points.rows(), 32U);
  for (std::size_t p = 0; p < points.rows(); ++p) {
    EXPECT_NEAR(points.x[0][p], 0.125 + 0.25 * static_cast<double>(p % 8), 1e-15);
    EXPECT_NEAR(points.x[1][p], 0.125 + 0.25 * static_cast<double>(p / 8), 1e-15);
    EXPECT_EQ(points.V0[p], 0.0625);
    EXPECT_EQ(points.mass(p), 125.0);
    EXPECT_EQ(points.v[0][p], 3.0);
    EXPECT_EQ(points.v[1][p], -4.0) << "the z component, not y";
    EXPECT_EQ(points.J[p], 1.0);
    EXPECT_EQ(points.id[p], p);
    for (const Column& component : points.tau) EXPECT_EQ(component[p], 0.0);
  }
}

/// The 45 degree face of x + z <= 1 cuts lattice squares in half: a triangle of half the area whose
/// centroid is a third of the square's side from its right angle.
TEST(FillRegions, FaceAt45Degrees) {
  const auto points =
      fill_regions<2>(scene_of({polygon_region("slope", "rock", {{0, 0}, {1, 0}, {0, 1}})}));
  const double a = 0.25;
  ASSERT_EQ(points.rows(), 10U) << "6 whole squares and 4 triangles";
  int triangles = 0;
  for (std::size_t p = 0; p < points.rows(); ++p) {
    const double i = std::floor(points.x[0][p] / a), k = std::floor(points.x[1][p] / a);
    const bool cut = i + k == 3.0;
    triangles += cut;
    const double part = cut ? 1.0 / 3.0 : 0.5;
    EXPECT_NEAR(points.x[0][p], (i + part) * a, 1e-15);
    EXPECT_NEAR(points.x[1][p], (k + part) * a, 1e-15);
    EXPECT_NEAR(points.V0[p], (cut ? 0.5 : 1.0) * a * a, 1e-16);
    EXPECT_NEAR(points.mass(p), 2000.0 * points.V0[p], 1e-12);
  }
  EXPECT_EQ(triangles, 4);
}

/// Mass and centre of mass are the polygon's, whatever its shape and sense of rotation.
TEST(FillRegions, MassAndCentreOfAnyPolygon) {
  for (Polygon polygon :
       {Polygon{{0.1, 0.07}, {2.3, 0.2}, {1.1, 1.9}},
        Polygon{{-0.3, -0.2}, {2.1, 0.1}, {2.0, 1.2}, {0.9, 0.4}, {0.3, 2.4}}, // concave
        Polygon{{0, 0},
                {2.9, 0},
                {2.9, 2.9},
                {2.0, 2.9},
                {2.0, 0.9},
                {0.9, 0.9},
                {0.9, 2.7},
                {0, 2.7}}}) {
    for (int sense = 0; sense < 2; ++sense) {
      const PolygonMeasure whole = measure(polygon);
      const auto points = fill_regions<2>(scene_of({polygon_region("part", "ice", polygon)}));
      EXPECT_NEAR(sum(masses_of(points)), 900.0 * std::abs(whole.area), 1e-9);
      for (std::size_t a = 0; a < 2; ++a) {
        double moment = 0.0;
        for (std::size_t p = 0; p < points.rows(); ++p) moment += points.V0[p] * points.x[a][p];
        EXPECT_NEAR(moment, std::abs(whole.area) * whole.centroid[a], 1e-12);
      }
      std::reverse(polygon.begin(), polygon.end());
    }
  }
}

/// In 3-D the same polygon, y from 0.1 to 0.6 on a lattice of 0.25:
/// slices 0.1-0.25, 0.25-0.5, 0.5-0.6.
TEST(FillRegions, PartialDepth) {
  Scene scene = scene_of({box("b", "rock", {0, 0}, {0.5, 0.25}, {1.0, 2.0, 3.0}, {0.1, 0.6})});
  scene.grid = grid_3d(0.5, {-1.0, 0.0, -1.0}, {3.0, 1.0, 3.0});
  const auto points = fill_regions<3>(scene);
  ASSERT_EQ(points.rows(), 6U);
  const std::array<double, 3> centre = {0.175, 0.375, 0.55};
  const std::array<double, 3> thickness = {0.15, 0.25, 0.1};
  for (std::size_t p = 0; p < 6; ++p) {
    const std::size_t slice = p / 2; // x fastest, then y
    EXPECT_NEAR(points.x[0][p], 0.125 + 0.25 * static_cast<double>(p % 2), 1e-15);
    EXPECT_NEAR(points.x[1][p], centre[slice], 1e-15);
    EXPECT_NEAR(points.x[2][p], 0.125, 1e-15);
    EXPECT_NEAR(points.V0[p], 0.0625 * thickness[slice], 1e-16);
    EXPECT_EQ(points.v[1][p], 2.0);
  }
  EXPECT_NEAR(sum(masses_of(points)), 2000.0 * 0.5 * 0.25 * 0.5, 1e-11);
}

TEST(FillRegions, RegionsSideBySide) {
  const auto points =
      fill_regions<2>(scene_of({box("below", "rock", {0, 0}, {1, 0.5}),
                                polygon_region("left", "ice", {{0, 0.5}, {1, 0.5}, {0, 1.5}}),
                                polygon_region("right", "rock", {{1, 0.5}, {1, 1.5}, {0, 1.5}})}));
  std::array<double, 3> mass = {0, 0, 0};
  for (std::size_t p = 0; p < points.rows(); ++p) {
    mass[points.region[p]] += points.mass(p);
    EXPECT_EQ(points.material[p], points.region[p] == 1 ? 1 : 0);
  }
  EXPECT_NEAR(mass[0], 1000.0, 1e-9);
  EXPECT_NEAR(mass[1], 450.0, 1e-9);
  EXPECT_NEAR(mass[2], 1000.0, 1e-9);
}

TEST(FillRegions, OverlapNamesBothRegions) {
  const std::string message = setup_error([] {
    fill_regions<2>(
        scene_of({box("lower", "rock", {0, 0}, {1, 1}), box("upper", "ice", {0.5, 0.75}, {2, 2})}));
  });
  EXPECT_NE(message.find("'lower'"), std::string::npos) << message;
  EXPECT_NE(message.find("'upper'"), std::string::npos) << message;
  EXPECT_NE(message.find("overlap"), std::string::npos) << message;
}

TEST(FillRegions, OutsideTheGridNamesTheRegion) {
  for (const auto& [lower, upper] : {std::pair{Point2{-1.1, 0}, Point2{1, 1}},
                                     {Point2{0, -1.1}, Point2{1, 1}},
                                     {Point2{0, 0}, Point2{3.1, 1}},
                                     {Point2{0, 0}, Point2{1, 3.1}}}) {
    const std::string message =
        setup_error([&] { fill_regions<2>(scene_of({box("far", "rock", lower, upper)})); });
    EXPECT_NE(message.find("'far'"), std::string::npos) << message;
    EXPECT_NE(message.find("outside the grid"), std::string::npos) << message;
  }
  Scene deep = scene_of({box("deep", "rock", {0, 0}, {1, 1}, {0, 0, 0}, {0.0, 1.5})});
  deep.grid = grid_3d(0.5, {-1.0, 0.0, -1.0}, {3.0, 1.0, 3.0});
  EXPECT_NE(setup_error([&] { fill_regions<3>(deep); }).find("'deep'"), std::string::npos);
}

TEST(FillRegions, EmptyRegionsAreNamed) {
  const std::string flat = setup_error([] {
    fill_regions<2>(
        scene_of({box("b", "rock", {0, 0}, {1, 1}), box("flat", "rock", {0, 2}, {1, 2})}));
  });
  EXPECT_NE(flat.find("'flat'"), std::string::npos) << flat;
  Scene no_depth = scene_of({box("sheet", "rock", {0, 0}, {1, 1})}); // depth 0 .. 0
  no_depth.grid = grid_3d(0.5, {-1.0, 0.0, -1.0}, {3.0, 1.0, 3.0});
  EXPECT_NE(setup_error([&] { fill_regions<3>(no_depth); }).find("'sheet'"), std::string::npos);
  EXPECT_NE(setup_error([] { fill_regions<2>(scene_of({})); }).find("no region"),
            std::string::npos);
}

TEST(FillRegions, UnknownMaterialIsNamed) {
  const std::string message = setup_error([] {
    fill_regions<2>(scene_of({box("b", "basalt", {0, 0}, {1, 1})}));
  });
  EXPECT_NE(message.find("'basalt'"), std::string::npos) << message;
  EXPECT_NE(message.find("'b'"), std::string::npos) << message;
}

/// Whole and cut squares, plane strain and 3-D: to the bit, and 4 bytes for each whole one.
TEST(FirstPlaces, AreThoseOfTheLattice) {
  const auto check = [](const auto& points, const Grid& grid, std::size_t cut) {
    constexpr auto dim = static_cast<int>(std::tuple_size_v<decltype(points.position(0))>);
    const FirstPlaces<dim> first(grid, points.x);
    ASSERT_EQ(first.points(), points.rows());
    for (std::size_t p = 0; p < points.rows(); ++p) EXPECT_EQ(first.of(p), points.position(p));
    EXPECT_LE(first.memory(), 4 * points.rows() + 2 * cut * (4 + 8 * dim));
  };
  const Polygon triangle = {{1, 1}, {2, 1}, {1, 2}};
  Scene scene = scene_of({box("b", "rock", {0, 0}, {1, 1}), box("c", "ice", {-1, 0.1}, {-0.2, 1}),
                          polygon_region("t", "ice", triangle)});
  check(fill_regions<2>(scene), scene.grid, 10);
  scene.grid = grid_3d(0.5, {-1.0, 0.0, -1.0}, {3.0, 1.0, 3.0});
  for (Region& region : scene.regions) region.depth = {0.1, 0.75};
  check(fill_regions<3>(scene), scene.grid, 64);
}
