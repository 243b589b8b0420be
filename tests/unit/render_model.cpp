// What model and lattice figures show, looked at as data.
#include "render/lattice_figure.hpp"
#include "render/line_chart.hpp"
#include "render/model_figure.hpp"
#include "tests/support/drawing_checks.hpp"
#include "tests/support/hand_made_slope.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace scarp::render {

using test::area_of;
using test::expect_nothing_clipped;
using test::expect_words_apart;
using test::extent_of;
using test::load_colour;
using test::says;
using test::slope_frame;
using test::slope_lattice_style;
using test::slope_outline;
using test::slope_pieces;
using test::slope_style;
using test::words_of;

TEST(Geometry, TrianglesTileAPolygon) {
  for (const Polyline& polygon :
       {slope_outline, Polyline(slope_outline.rbegin(), slope_outline.rend())}) {
    double area = 0.0;
    for (const Polyline& t : triangulated(polygon)) {
      ASSERT_EQ(t.size(), 3U);
      const double twice =
          (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
      EXPECT_GT(twice, 0.0);
      area += 0.5 * twice;
      const Point middle = {(t[0].x + t[1].x + t[2].x) / 3.0, (t[0].y + t[1].y + t[2].y) / 3.0};
      EXPECT_TRUE(is_inside(middle, polygon));
    }
    EXPECT_DOUBLE_EQ(area, 40.0 * 4.0 + 0.5 * (16.0 + 26.0) * 10.0);
  }
  EXPECT_TRUE(triangulated({{0, 0}, {1, 0}}).empty());
  const Polyline bow_tie = {{0, 0}, {2, 1}, {2, 0}, {0, 2}};
  EXPECT_THROW(triangulated(bow_tie), std::invalid_argument);
}

TEST(Geometry, InsideIsByTheEvenOddRule) {
  EXPECT_TRUE(is_inside({20, 9}, slope_outline));
  EXPECT_FALSE(is_inside({22, 9}, slope_outline));
  EXPECT_FALSE(is_inside({-1, 1}, slope_outline));
}

TEST(Model, DimensionsPartsAndPlacesKeepApart) {
  for (const int width : {900, 1600, 2400}) {
    ModelStyle style = slope_style();
    style.width = width;
    const Drawing drawing = draw_model(slope_frame(), style);
    for (const char* const words :
         {"26 m", "foreland", "4 m", "14 m", "2 m", "8 m", "slope", "load", "A", "B", "C"})
      EXPECT_TRUE(says(drawing, words)) << words;
    EXPECT_FALSE(says(drawing, "40 m")); // the body's own only without dimensions
    expect_nothing_clipped(drawing);
    expect_words_apart(drawing);
    // The places' labels stand above the face, not on it.
    const Box part = extent_of(drawing, load_colour);
    const Point shoulder = {part.upper.x, part.lower.y};
    for (const char* const name : {"A", "B", "C"}) {
      const Point corner = covered(words_of(drawing, name)).lower;
      EXPECT_GT(corner.y - shoulder.y, shoulder.x - corner.x) << name;
    }
  }
}

TEST(Model, DimensionsStandBeyondTheWordsOfASupport) {
  ModelStyle style = slope_style();
  style.right = {Support::roller, "wall"};
  style.dimensions = {{{40, 14}, {40, 4}, "", 1.0}, {{40, 4}, {40, 0}, "", 1.0}};
  const Drawing drawing = draw_model(slope_frame(), style);
  const double wall = covered(words_of(drawing, "wall")).upper.x;
  EXPECT_GT(covered(words_of(drawing, "4 m")).lower.x, wall);
  // The upper one, in line with it, went along.
  EXPECT_EQ(covered(words_of(drawing, "10 m")).lower.x, covered(words_of(drawing, "4 m")).lower.x);
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);
}

TEST(Model, WithoutDimensionsTheBodyIsMeasured) {
  ModelStyle style = slope_style();
  style.dimensions.clear();
  const Drawing drawing = draw_model(slope_frame(), style);
  EXPECT_TRUE(says(drawing, "40 m"));
  EXPECT_TRUE(says(drawing, "16 m"));
}

TEST(Model, APartTooSmallForItsLabelGoesToTheLegend) {
  ModelStyle style = slope_style();
  style.parts[1].label = "a load with a very long name";
  const Drawing drawing = draw_model(slope_frame(), style);
  const Words label = words_of(drawing, style.parts[1].label);
  EXPECT_GT(label.position.x, covered(words_of(drawing, "B")).upper.x);
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);
}

TEST(Model, NotesStandWhereTheBodyIsNot) {
  const Drawing drawing = draw_model(slope_frame(), slope_style());
  const Words note = words_of(drawing, "c = 20 kPa");
  EXPECT_GT(note.position.x, words_of(drawing, "B").position.x);
  EXPECT_LT(note.position.x, words_of(drawing, "4 m").position.x); // above the foreland
}

TEST(Model, RefusesPartsWhoseSidesCross) {
  ModelStyle style;
  style.parts = {{{{0, 0}, {2, 1}, {2, 0}, {0, 2}}, "bow tie"}};
  EXPECT_THROW(draw_model(slope_frame(), style), std::invalid_argument);
}

TEST(Lattice, FullAndCutPiecesInTwoColours) {
  const Drawing drawing = draw_lattice(slope_pieces(), slope_lattice_style());
  for (const char* const words :
       {"full square", "cut by the face", "background grid", "free surface", "x (m)", "z (m)"})
    EXPECT_TRUE(says(drawing, words)) << words;
  EXPECT_GT(area_of(drawing, palette::blue), area_of(drawing, palette::vermilion));
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);
}

TEST(Lattice, OnlyWhatIsInTheViewIsDrawn) {
  const std::vector<LatticePiece> pieces = slope_pieces();
  LatticeStyle style = slope_lattice_style();
  style.view = {{10.1, 3.1}, {10.4, 3.4}}; // within a full square
  const Drawing drawing = draw_lattice(pieces, style);
  EXPECT_FALSE(says(drawing, "cut by the face"));
  style.view = {{30.0, 5.0}, {31.0, 6.0}};
  EXPECT_THROW(draw_lattice(pieces, style), std::invalid_argument);
  style = slope_lattice_style();
  style.cell_size = 0.0;
  EXPECT_THROW(draw_lattice(pieces, style), std::invalid_argument);
  style = slope_lattice_style();
  style.view = {};
  EXPECT_THROW(draw_lattice(pieces, style), std::invalid_argument);
}

} // namespace scarp::render
