// The test of the tests: what a reviewer would see must fail.
#include "render/frame_figure.hpp"
#include "tests/support/fresh_directory.hpp"
#include "tests/support/hand_made_frames.hpp"
#include "tests/support/image_compare.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace scarp::test {

namespace {

using render::ColourRange;
using render::FrameStyle;
using render::Image;

class Comparator : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path folder = fresh_directory();
    std::filesystem::create_directory(folder / "baselines");
    places_ = {folder / "baselines", folder / "results", false};
    render::write_png(places_.baselines / "pile.png", picture(style()));
  }

  static FrameStyle style() {
    FrameStyle style;
    style.width = 480;
    style.height = 320;
    style.range = ColourRange{0.0, 1.2, 12, false, false};
    style.view = render::Box{{0.0, 0.0}, {0.3, 0.11}};
    style.title = "strain";
    return style;
  }

  static Image picture(const FrameStyle& style) {
    return render::render_frame(slumped_pile(1.0), style);
  }

  testing::AssertionResult matches(const FrameStyle& changed) const {
    return matches_baseline(picture(changed), "pile", places_);
  }

  BaselinePlaces places_;
};

} // namespace

TEST_F(Comparator, TheSamePicturePasses) {
  EXPECT_TRUE(matches(style()));
  EXPECT_FALSE(std::filesystem::exists(places_.results / "pile.actual.png"));
}

TEST_F(Comparator, PicturesAreTheSameBytesEveryTime) {
  EXPECT_EQ(picture(style()), picture(style()));
}

TEST_F(Comparator, ARangeFivePerCentOffFails) {
  FrameStyle changed = style();
  changed.range->upper *= 1.05;
  EXPECT_FALSE(matches(changed));
}

TEST_F(Comparator, OneBandLessFails) {
  FrameStyle changed = style();
  changed.range->bands = 11;
  EXPECT_FALSE(matches(changed));
}

TEST_F(Comparator, AnotherTitleFails) {
  FrameStyle changed = style();
  changed.title = "stress";
  EXPECT_FALSE(matches(changed));
}

TEST_F(Comparator, AnotherSizeFails) {
  FrameStyle changed = style();
  changed.width = 482;
  const testing::AssertionResult result = matches(changed);
  EXPECT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("482 x 320"), std::string::npos);
}

TEST_F(Comparator, AMismatchLeavesPicturesAndTheCommand) {
  FrameStyle changed = style();
  changed.draw_points = true;
  const testing::AssertionResult result = matches(changed);
  EXPECT_FALSE(result);
  EXPECT_TRUE(std::filesystem::exists(places_.results / "pile.actual.png"));
  EXPECT_TRUE(std::filesystem::exists(places_.results / "pile.diff.png"));
  EXPECT_NE(std::string(result.message()).find("cp "), std::string::npos);
}

TEST_F(Comparator, AMissingBaselineFailsAndLeavesThePicture) {
  const testing::AssertionResult result = matches_baseline(picture(style()), "absent", places_);
  EXPECT_FALSE(result);
  EXPECT_TRUE(std::filesystem::exists(places_.results / "absent.actual.png"));
}

TEST_F(Comparator, UpdatingWritesTheBaselineAndStillFails) {
  places_.update = true;
  EXPECT_FALSE(matches_baseline(picture(style()), "new", places_));
  places_.update = false;
  EXPECT_TRUE(matches_baseline(picture(style()), "new", places_));
}

TEST(ImageDifference, IsTheWorstTileNotTheMean) {
  constexpr std::size_t side = 80;
  const Image a = {side, side, std::vector<unsigned char>(3 * side * side, 255)};
  Image b = a;
  for (std::size_t y = 8; y < 16; ++y) // one tile of a hundred goes black
    for (std::size_t x = 8; x < 16; ++x)
      for (std::size_t channel = 0; channel < 3; ++channel) b.rgb[3 * (y * side + x) + channel] = 0;
  EXPECT_DOUBLE_EQ(difference(a, b).worst_tile, 1.0);
  EXPECT_NEAR(difference(a, b).mean, 0.01, 1e-12);
}

} // namespace scarp::test
