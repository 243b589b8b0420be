// scarp render: pictures of a series.
#include "tests/end_to_end/program.hpp"

namespace scarp::test {

class Render : public EndToEnd {
 protected:
  /// Six frames in out/.
  Render() { expect_success(scarp({"run", "block.toml", "--out", "out"})); }

  Result render(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"render",  "out", "--out",    "pictures",
                                      "--width", "320", "--height", "240"};
    words.insert(words.end(), more.begin(), more.end());
    return scarp(words);
  }
  /// Names without "block_" and ".png".
  std::vector<std::string> pictures() const {
    std::vector<std::string> names = names_in(*this / "pictures");
    for (std::string& name : names) {
      EXPECT_EQ(png_size(*this / "pictures" / name), (Size{320, 240})) << name;
      EXPECT_TRUE(name.starts_with("block_") && name.ends_with(".png")) << name;
      name = name.substr(6, name.size() - 10);
    }
    return names;
  }
};

TEST_F(Render, DrawsAllFramesUnlessAskedOtherwise) {
  const Result result = render({});
  expect_success(result);
  EXPECT_EQ(lines_of(result.out).size(), 6U);
  EXPECT_EQ(lines_of(result.out).back(), "pictures/block_equivalent_plastic_strain_000005.png");
  EXPECT_EQ(pictures().size(), 6U);
}

TEST_F(Render, DrawsTheLastFrame) {
  expect_success(render({"--frames", "last", "--field", "velocity"}));
  EXPECT_EQ(pictures(), std::vector<std::string>{"velocity_000005"});
}

TEST_F(Render, DrawsAListOfFramesBesideTheSeriesInTheSizeAskedFor) {
  expect_success(scarp({"render", "out/block.pvd", "--frames", "0,2-3", "--field", "mean_stress",
                        "--width", "400", "--height", "0", "--points"}));
  for (const char* frame : {"0", "2", "3"}) {
    const fs::path file = *this / ("out/block_mean_stress_00000" + std::string(frame) + ".png");
    ASSERT_TRUE(fs::exists(file));
    EXPECT_EQ(png_size(file).width, 400U);
    EXPECT_GT(png_size(file).height, 100U); // "what the body needs"
  }
  EXPECT_EQ(names_in(*this / "out").size(), 12U);
}

/// The same picture whichever other frames are drawn: one range and one view for the series.
TEST_F(Render, DrawsAFrameAlikeAloneAndAmongOthers) {
  expect_success(render({}));
  const fs::path file = *this / "pictures/block_equivalent_plastic_strain_000002.png";
  const std::string among = content(file);
  fs::remove(file);
  expect_success(render({"--frames", "2"}));
  EXPECT_TRUE(content(file) == among);
}

TEST_F(Render, NamesTheFieldsThereAreWhenAskedForAnother) {
  expect_complaint(render({"--field", "temperature"}), 2,
                   {"'temperature'", "velocity", "mean_stress"});
  EXPECT_FALSE(fs::exists(*this / "pictures") && !fs::is_empty(*this / "pictures"));
}

TEST_F(Render, RefusesFramesThatAreNone) {
  for (const char* frames : {"6", "0,6", "4-6", "first", "0,,1", "0-", "-1", "1.5", "0 1", ""})
    expect_complaint(render({"--frames", frames}), 2, {std::string("--frames ") + frames + ":"});
  EXPECT_FALSE(fs::exists(*this / "pictures"));
}

TEST_F(Render, RefusesASeriesThatIsNone) {
  fs::create_directory(*this / "empty");
  expect_complaint(scarp({"render", "empty"}), 1, {"empty"});
  expect_complaint(scarp({"render", "nowhere"}), 1, {"nowhere"});
  expect_complaint(scarp({"render", "block.toml"}), 1, {"block.toml"});
}

} // namespace scarp::test
