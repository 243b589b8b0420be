#include "render/chart_panels.hpp"
#include "render/field_panels.hpp"
#include "render/frame_figure.hpp"
#include "render/lattice_figure.hpp"
#include "render/line_chart.hpp"
#include "render/model_figure.hpp"
#include "render/multi_panel.hpp"
#include "render/parity_chart.hpp"
#include "render/validation_figure.hpp"
#include "tests/support/hand_made_frames.hpp"
#include "tests/support/hand_made_slope.hpp"
#include "tests/support/image_compare.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scarp::render {

using test::matches_baseline;
using test::slumped_pile;

namespace {

constexpr int width = 480;
constexpr int height = 320;

FrameStyle small_style() {
  FrameStyle style;
  style.width = width;
  style.height = height;
  style.range = ColourRange{0.0, 1.2, 12, false, false};
  style.view = Box{{0.0, 0.0}, {0.3, 0.11}};
  return style;
}

FrameStyle small_style(const Field& field) {
  FrameStyle style = small_style();
  style.field = field;
  style.range.reset();
  return style;
}

io::Table experiment() {
  return {{"x_m", "z_m"}, {{0.02, 0.08, 0.14, 0.2, 0.24}, {0.1, 0.097, 0.092, 0.08, 0.06}}};
}

} // namespace

TEST(FrameFigure, PlasticStrainInBands) {
  FrameStyle style = small_style();
  style.title = "A slumped pile";
  EXPECT_TRUE(matches_baseline(render_frame(slumped_pile(1.0), style), "frame_plastic_strain"));
}

TEST(FrameFigure, ValuesBeyondTheRangeGiveArrows) {
  FrameStyle style = small_style();
  style.colours = ColourMap::inferno;
  style.range = ColourRange{0.2, 0.8, 6, true, true};
  EXPECT_TRUE(matches_baseline(render_frame(slumped_pile(1.0), style), "frame_arrows"));
}

TEST(FrameFigure, NegativeValuesInAnotherMap) {
  FrameStyle style = small_style({"mean_stress"});
  style.colours = ColourMap::cividis;
  EXPECT_TRUE(matches_baseline(render_frame(slumped_pile(0.0), style), "frame_mean_stress"));
}

TEST(FrameFigure, PointsAsDiscs) {
  FrameStyle style = small_style({"velocity"});
  style.draw_points = true;
  EXPECT_TRUE(matches_baseline(render_frame(slumped_pile(0.6), style), "frame_points"));
}

TEST(FrameFigure, RegionsAreNamedNotScaled) {
  const FrameStyle style = small_style({"region"});
  EXPECT_TRUE(matches_baseline(render_frame(slumped_pile(0.6), style), "frame_regions"));
}

TEST(FrameFigure, SolidBody) {
  FrameStyle style = small_style({"velocity"});
  style.view.reset();
  EXPECT_TRUE(matches_baseline(render_frame(test::heap(), style), "frame_solid"));
}

TEST(MultiPanel, OneBarForAll) {
  const std::vector<io::Frame> frames = {slumped_pile(0.0), slumped_pile(0.5), slumped_pile(1.0)};
  FrameStyle style = small_style();
  style.height = 0;
  EXPECT_TRUE(matches_baseline(render_panels(frames, style), "panels"));
}

TEST(ModelFigure, SupportsAndDimensions) {
  ModelStyle style;
  style.width = width;
  style.left = {Support::roller, "symmetry"};
  style.right = {Support::frictional, "gate"};
  style.bottom = {Support::fixed, "fixed"};
  style.places = {{{0.15, 0.05}, "A"}};
  style.notes = {"φ = 19.8°", "c = 0"};
  EXPECT_TRUE(matches_baseline(render_model(slumped_pile(0.0), style), "model"));
}

TEST(ValidationFigure, ModelOverExperiment) {
  ValidationStyle style;
  style.width = width;
  style.height = height;
  style.surface = experiment();
  EXPECT_TRUE(matches_baseline(render_validation(slumped_pile(1.0), style), "validation"));
}

TEST(LineChart, CurvesWithLegend) {
  std::vector<Curve> curves(2);
  curves[0].label = "kinetic energy";
  curves[1].label = "dissipated";
  curves[1].line = LineKind::dashed;
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.02 * i;
    for (Curve& curve : curves) curve.x.push_back(t);
    curves[0].y.push_back(3.0 * std::exp(-50.0 * (t - 0.3) * (t - 0.3)));
    curves[1].y.push_back(5.0 * t * t);
  }
  const ChartStyle style = {.x_name = "time",
                            .x_unit = "s",
                            .y_name = "energy",
                            .y_unit = "J/m",
                            .width = width,
                            .height = height};
  EXPECT_TRUE(matches_baseline(render_chart(curves, style), "chart"));
}

TEST(ChartPanels, SpansAFamilyAndParity) {
  Chart history = {{}, {.x_name = "time", .x_unit = "s", .y_name = "velocity", .y_unit = "m/s"}};
  history.style.title = "stages";
  history.style.spans = {{"I", {0.0, 3.0}}, {"II", {3.0, 6.0}}, {"III", {6.0, 9.0}}};
  Chart family = {{}, {.x_name = "time", .x_unit = "s", .y_name = "energy", .y_unit = "kJ"}};
  family.style.title = "fifteen curves";
  family.style.parameter_name = "c";
  family.style.parameter_unit = "kPa";
  for (int value = 15; value < 30; ++value) {
    Curve curve;
    curve.parameter = value;
    curve.weight = 0.7;
    for (int i = 0; i <= 60; ++i) {
      const double t = 0.25 * i;
      curve.x.push_back(t);
      curve.y.push_back(3e4 / value * std::exp(-0.4 * (t - 5.0) * (t - 5.0)));
    }
    family.curves.push_back(curve);
  }
  history.curves = {{"toe", family.curves[0].x, family.curves[0].y}};
  const std::vector<double> reference = {1.0, 2.0, 3.5, 4.0, 5.2};
  const std::vector<double> computed = {1.1, 1.9, 3.7, 3.9, 5.3};
  const Chart parity =
      parity_chart(reference, computed,
                   {.quantity = "velocity", .unit = "m/s", .tolerance = 0.05, .notes = {"R² = 1"}});
  const Chart residual =
      residual_chart(reference, {0.1, -0.1, 0.2, -0.1, 0.1}, {.quantity = "velocity"});
  const ChartPanelsStyle style = {.columns = 2, .width = 640};
  EXPECT_TRUE(matches_baseline(render_chart_panels({history, family, parity, residual}, style),
                               "chart_panels"));
}

TEST(FieldPanels, ColumnsWithTheirOwnBars) {
  FrameStyle style = small_style();
  style.width = 640;
  style.height = 0;
  style.columns = 2;
  const std::vector<FieldPanel> fields = {{{"mean_stress", -1, "kPa"}}, {{"velocity", 0}}};
  EXPECT_TRUE(
      matches_baseline(render_field_panels(slumped_pile(0.6), fields, style), "field_panels"));
}

TEST(ModelFigure, PartsDimensionsAndPlaces) {
  ModelStyle style = test::slope_style();
  style.width = 640;
  EXPECT_TRUE(matches_baseline(render_model(test::slope_frame(), style), "model_slope"));
}

TEST(LatticeFigure, FullAndCutPieces) {
  LatticeStyle style = test::slope_lattice_style();
  style.width = width;
  EXPECT_TRUE(matches_baseline(render_lattice(test::slope_pieces(), style), "lattice"));
}

} // namespace scarp::render
