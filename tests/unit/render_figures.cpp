// What figures say, looked at as data.
#include "render/field.hpp"
#include "render/field_panels.hpp"
#include "render/frame_figure.hpp"
#include "render/image.hpp"
#include "render/line_chart.hpp"
#include "render/multi_panel.hpp"
#include "render/plot_area.hpp"
#include "render/ticks.hpp"
#include "render/validation_figure.hpp"
#include "tests/support/drawing_checks.hpp"
#include "tests/support/fresh_directory.hpp"
#include "tests/support/hand_made_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace scarp::render {

using test::expect_nothing_clipped;
using test::expect_words_apart;
using test::says;
using test::slumped_pile;
using test::words_of;

TEST(Field, MagnitudesComponentsAndTheirErrors) {
  io::Frame frame = test::empty_frame(1.0, 2.0, 2.0);
  test::add_point(frame, 0.5, 0.5, 1.0);
  test::add_column(frame, "velocity", 3, {3.0, 0.0, -4.0});
  test::add_column(frame, "stress", 6, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  EXPECT_EQ(field_values(frame, {"velocity"}), std::vector<double>{5.0});
  EXPECT_EQ(field_values(frame, {"velocity", 2}), std::vector<double>{-4.0});
  EXPECT_EQ(field_values(frame, {"stress", 3}), std::vector<double>{4.0});
  EXPECT_EQ(field_label(frame, {"stress", 3}), "stress xy");
  EXPECT_EQ(field_label(frame, {"velocity"}), "velocity magnitude");
  EXPECT_EQ(field_unit({"velocity"}), "m/s");
  EXPECT_THROW(field_values(frame, {"stress"}), std::invalid_argument);
  EXPECT_THROW(field_values(frame, {"velocity", 3}), std::invalid_argument);
  EXPECT_THROW(field_values(frame, {"colour"}), std::runtime_error);
}

TEST(Field, EveryComponentThereIsIsListedForOneThatIsNot) {
  const auto complaint = [](const char* name, int components, int component) -> std::string {
    try {
      require_component({name, components, {}}, component);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  for (const int components : {1, 3, 6, 9}) {
    for (int c = 0; c < components; ++c) EXPECT_EQ(complaint("field", components, c), "");
    EXPECT_EQ(complaint("field", components, -1).empty(), components <= 3);
  }
  EXPECT_EQ(complaint("gap", 1, 1), "gap has no component 1; must be 0 or -1");
  EXPECT_EQ(complaint("velocity", 3, -2),
            "velocity has no component -2; must be 0 (x), 1 (y), 2 (z) or -1 (magnitude)");
  EXPECT_EQ(complaint("stress", 6, -1),
            "stress has no magnitude; must be 0 (xx), 1 (yy), 2 (zz), 3 (xy), 4 (yz) or 5 (xz)");
  EXPECT_EQ(complaint("velocity_gradient", 9, 9),
            "velocity_gradient has no component 9; must be 0 (xx), 1 (xy), 2 (xz), 3 (yx), 4 (yy), "
            "5 (yz), 6 (zx), 7 (zy) or 8 (zz)");
  EXPECT_EQ(complaint("four", 4, 4), "four has no component 4; must be 0, 1, 2 or 3");
}

TEST(Field, StressComponentsInKilopascals) {
  io::Frame frame = test::empty_frame(1.0, 2.0, 2.0);
  test::add_point(frame, 0.5, 0.5, 1.0);
  test::add_column(frame, "stress", 6, {-1e3, -2e3, -3e3, 0.0, 0.0, 500.0});
  EXPECT_EQ(field_values(frame, {"stress", 2, "kPa"}), std::vector<double>{-3.0});
  EXPECT_EQ(field_unit({"stress", 2, "kPa"}), "kPa");
  EXPECT_EQ(field_label(frame, {"stress", 2, "kPa"}), "vertical stress");
  EXPECT_EQ(field_label(frame, {"stress", 0}), "horizontal stress");
  EXPECT_EQ(field_label(frame, {"stress", 5}), "shear stress");
  EXPECT_THROW(field_values(frame, {"stress", 2, "mm"}), std::invalid_argument);
  frame.dimension = 3;
  EXPECT_EQ(field_label(frame, {"stress", 2}), "stress zz");
}

TEST(ColourRange, HasRoundBandsThatCoverTheValues) {
  const ColourRange strain = round_range({0.0, 9.0, 0.001, 6.7}, 12);
  EXPECT_EQ(strain.lower, 0.0);
  EXPECT_DOUBLE_EQ(strain.upper, 7.2);
  EXPECT_EQ(strain.bands, 12);
  EXPECT_FALSE(strain.values_below);
  EXPECT_TRUE(strain.values_above);
  const ColourRange stress = round_range({-1800.0, 0.0, -1790.0, -10.0}, 12);
  EXPECT_DOUBLE_EQ(stress.lower, -1800.0);
  EXPECT_DOUBLE_EQ(stress.upper, 0.0);
  EXPECT_FALSE(stress.values_below);
  const ColourRange density = round_range({2600.0, 2660.0, 2600.0, 2660.0}, 12);
  EXPECT_DOUBLE_EQ(density.lower, 2600.0);
  EXPECT_DOUBLE_EQ(density.upper, 2660.0);
  const ColourRange nothing = round_range({}, 12);
  EXPECT_EQ(nothing.lower, 0.0);
  EXPECT_GE(nothing.upper, 1.0);
}

TEST(ColourRange, IsCommonToAllFrames) {
  const std::vector<io::Frame> frames = {slumped_pile(0.2), slumped_pile(1.0)};
  const ColourRange range = common_range(frames, {});
  EXPECT_EQ(range.lower, 0.0);
  EXPECT_NEAR(range.upper, 1.2, 1e-12);
  EXPECT_EQ(range.edges().size(), static_cast<std::size_t>(range.bands) + 1);
}

TEST(View, IsCommonToAllFramesWithoutPointsThrownOff) {
  std::vector<io::Frame> frames = {slumped_pile(0.0), slumped_pile(1.0)};
  const Box view = common_view(frames);
  test::add_point(frames[1], 0.39, 0.11, 1e-6);
  EXPECT_EQ(common_view(frames).upper.x, view.upper.x);
  EXPECT_GT(view.upper.x, 0.25);
  EXPECT_LT(view.upper.x, 0.3);
  EXPECT_GT(view.upper.y, 0.1);
}

TEST(Ticks, AreRoundAndLabelledAlike) {
  EXPECT_EQ(ticks(0.0, 0.47, 6).size(), 5U);
  EXPECT_EQ(tick_labels(ticks(0.0, 0.47, 6)).back(), "0.4");
  EXPECT_EQ(tick_labels({0.0, 0.25, 0.5}), (std::vector<std::string>{"0.00", "0.25", "0.50"}));
  EXPECT_EQ(tick_labels({-1.0, 0.0}), (std::vector<std::string>{"−1", "0"}));
  EXPECT_EQ(common_power({0.0, 200000.0}), 3);
  EXPECT_EQ(common_power({0.0, 0.005}), -3);
  EXPECT_EQ(common_power({0.0, 25000.0}), 0);
  EXPECT_EQ(unit_label("Pa", 3), "(10³ Pa)");
  EXPECT_EQ(unit_label("", 0), "");
}

TEST(PlotArea, FitKeepsOneScale) {
  const PlotArea area =
      fit_equal({{0.0, 0.0}, {4.0, 1.0}}, {{10.0, 10.0}, {110.0, 210.0}}, 0.5, 1.0);
  EXPECT_DOUBLE_EQ(area.pixels.width() / area.world.width(),
                   area.pixels.height() / area.world.height());
  EXPECT_DOUBLE_EQ(area.pixels.upper.y, 210.0);
  EXPECT_DOUBLE_EQ(area.to_pixels(Point{4.0, 1.0}).x, 110.0);
}

TEST(Panels, BearLettersTimesAndOneBar) {
  const std::vector<io::Frame> frames = {slumped_pile(0.0), slumped_pile(1.0)};
  FrameStyle style;
  style.height = 0;
  const Drawing drawing = draw_panels(frames, style);
  EXPECT_TRUE(says(drawing, "a)  t = 0.00 s"));
  EXPECT_TRUE(says(drawing, "b)  t = 0.60 s"));
  EXPECT_TRUE(says(drawing, "equivalent plastic strain (-)"));
  EXPECT_TRUE(says(drawing, "x (m)"));
  EXPECT_EQ(drawing.height % 2, 0);
  expect_nothing_clipped(drawing);
}

TEST(Panels, InColumnsShareAxesAndBar) {
  const std::vector<io::Frame> frames = {slumped_pile(0.0), slumped_pile(0.25), slumped_pile(0.5),
                                         slumped_pile(0.75), slumped_pile(1.0)};
  FrameStyle style;
  style.height = 0;
  style.columns = 2;
  const Drawing drawing = draw_panels(frames, style);
  const Words a = words_of(drawing, "a)  t = 0.00 s");
  const Words b = words_of(drawing, "b)  t = 0.15 s");
  const Words e = words_of(drawing, "e)  t = 0.60 s");
  EXPECT_EQ(a.position.y, b.position.y);
  EXPECT_LT(a.position.x, b.position.x);
  EXPECT_EQ(a.position.x, e.position.x);
  const auto count = [&](const std::string& text) {
    return std::count_if(drawing.texts.begin(), drawing.texts.end(),
                         [&](const Words& words) { return words.text == text; });
  };
  EXPECT_EQ(count("x (m)"), 2); // below the last panel of each column
  EXPECT_EQ(count("z (m)"), 3); // left of each row
  EXPECT_EQ(count("equivalent plastic strain (-)"), 1);
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);
}

TEST(FieldPanels, EachHasItsOwnBar) {
  const io::Frame frame = slumped_pile(1.0);
  const std::vector<FieldPanel> fields = {
      {{"mean_stress", -1, "kPa"}, "mean stress at the end"}, {{"velocity", 0}}, {{"region"}}};
  for (const int columns : {1, 2, 3}) {
    FrameStyle style;
    style.height = 0;
    style.columns = columns;
    const Drawing drawing = draw_field_panels(frame, fields, style);
    EXPECT_TRUE(says(drawing, "a)  mean stress at the end"));
    EXPECT_TRUE(says(drawing, "mean stress (kPa)"));
    EXPECT_TRUE(says(drawing, "b)  velocity x"));
    EXPECT_TRUE(says(drawing, "velocity x (m/s)"));
    EXPECT_TRUE(says(drawing, "c)  region"));
    expect_nothing_clipped(drawing);
    expect_words_apart(drawing);
  }
  EXPECT_THROW(draw_field_panels(frame, {}, {}), std::invalid_argument);
}

TEST(Panels, NothingIsClippedAtAnySize) {
  const std::vector<io::Frame> frames = {slumped_pile(1.0)};
  for (const int width : {320, 480, 1000, 1920, 3840}) {
    for (const int height : {0, 240, 700, 1080}) {
      FrameStyle style;
      style.width = width;
      style.height = height;
      if (width > 2000 && height == 240) continue; // words as high as the picture
      style.title = "Title";
      expect_nothing_clipped(draw_panels(frames, style));
    }
  }
}

TEST(Panels, RefuseWhatMakesNoPicture) {
  const std::vector<io::Frame> frames = {slumped_pile(1.0)};
  EXPECT_THROW(draw_panels({}, {}), std::invalid_argument);
  FrameStyle style;
  style.height = 30;
  EXPECT_THROW(draw_panels(frames, style), std::invalid_argument);
  style = {};
  style.bands = 0;
  EXPECT_THROW(draw_panels(frames, style), std::invalid_argument);
  style = {};
  style.columns = 0;
  EXPECT_THROW(draw_panels(frames, style), std::invalid_argument);
  style = {};
  style.width = 100000;
  style.height = 0;
  EXPECT_THROW(render_panels(frames, style), std::invalid_argument);
}

TEST(Chart, RefusesCurvesThatDoNotFit) {
  EXPECT_THROW(draw_chart({{"a", {1.0, 2.0}, {1.0}}}, {}), std::invalid_argument);
  EXPECT_THROW(draw_chart({}, {}), std::invalid_argument);
  ChartStyle style;
  style.height = 0;
  EXPECT_THROW(draw_chart({{"a", {1.0, 2.0}, {1.0, 2.0}}}, style), std::invalid_argument);
}

TEST(Validation, TheLegendTellsPointsAndErrors) {
  ValidationStyle style;
  style.surface = io::Table{{"x_m", "z_m"}, {{0.1, 0.15}, {0.06, 0.06}}};
  const Drawing drawing = draw_validation(slumped_pile(0.0), style);
  EXPECT_TRUE(says(drawing, "free surface, scarp, 3 200 points: RMS 40.0 mm, largest 40.0 mm"));
  EXPECT_TRUE(says(drawing, "before release"));
  EXPECT_TRUE(says(drawing, "z (m)"));
  expect_nothing_clipped(drawing);
}

TEST(Image, RoundTripsThroughAFile) {
  const std::filesystem::path file = test::fresh_directory() / "image.png";
  Image image = {3, 2, {}};
  for (int i = 0; i < 18; ++i) image.rgb.push_back(static_cast<unsigned char>(13 * i));
  write_png(file, image);
  EXPECT_EQ(read_png(file), image);
}

TEST(Image, ATruncatedFileIsAnError) {
  const std::filesystem::path file = test::fresh_directory() / "truncated.png";
  Image image = {64, 64, std::vector<unsigned char>(std::size_t{3} * 64 * 64)};
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<unsigned char>((i * i) % 251);
  write_png(file, image);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(read_png(file), std::runtime_error);
}

TEST(Image, ErrorsNameTheFile) {
  const Image image = {1, 1, {1, 2, 3}};
  try {
    write_png("/nonexistent/a.png", image);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/a.png"), std::string::npos);
  }
  EXPECT_THROW(read_png("/nonexistent/a.png"), std::runtime_error);
  EXPECT_THROW(write_png("a.png", Image{2, 2, {}}), std::invalid_argument);
  const std::filesystem::path file = test::fresh_directory() / "text.png";
  std::ofstream(file) << "not a picture";
  EXPECT_THROW(read_png(file), std::runtime_error);
}

} // namespace scarp::render
