// scarp render: pictures of a series.
#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/study_fixture.hpp"

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

/// The pictures of one process and of several, for words that are handed on as they were given.
TEST_F(Render, DrawsTheSamePicturesWithAnyNumberOfJobs) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{},
        {"--field=velocity", "--component", "2", "--range", "-0.3", "0.1", "--bands", "7"},
        {"--points", "--title", "--a = b", "--colours", "inferno", "--frames", "5,1-3"}}) {
    std::map<std::string, std::string> bytes;
    std::string said;
    for (const char* jobs : {"1", "2", "3"}) {
      fs::remove_all(*this / "pictures");
      std::vector<std::string> words = more;
      words.insert(words.end(), {"--jobs", jobs});
      const Result result = render(words);
      expect_success(result);
      if (said.empty()) said = result.out;
      EXPECT_EQ(result.out, said);
      const std::vector<std::string> names = names_in(*this / "pictures");
      EXPECT_EQ(names.size(), lines_of(said).size());
      for (const std::string& name : names) {
        const std::string now = content(*this / "pictures" / name);
        EXPECT_TRUE(bytes.emplace(name, now).first->second == now) << name << ", jobs " << jobs;
      }
    }
  }
}

TEST_F(Render, SaysOnceWhatOneOfItsJobsCouldNotDraw) {
  fs::create_directories(*this / "pictures/block_equivalent_plastic_strain_000003.png");
  expect_complaint(render({"--jobs", "2"}), 1,
                   {"cannot write pictures/block_equivalent_plastic_strain_000003.png"});
  // One job had 0, 2 and 4 to draw, the other 1, 3 and 5.
  for (const char* frame : {"0", "1", "2", "4"}) {
    const std::string name = std::string("block_equivalent_plastic_strain_00000") + frame + ".png";
    EXPECT_EQ(png_size(*this / "pictures" / name), (Size{320, 240})) << name;
  }
  EXPECT_EQ(names_in(*this / "pictures").size(), 5U);
}

TEST_F(Render, EndsItsJobsWhenItIsEnded) {
  const std::string out = (*this / "pictures").string();
  std::string frames = "0-5";
  for (int i = 0; i < 200; ++i) frames += ",0-5";
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    fs::remove_all(out);
    Program program(directory_, {"render", "out", "--out", out, "--frames", frames, "--jobs", "2"});
    await(*this / "pictures/block_equivalent_plastic_strain_000001.png");
    EXPECT_EQ(processes_with(out).size(), 3U);
    program.kill(signal);
    if (signal == SIGKILL)
      EXPECT_EQ(program.wait().signal, SIGKILL);
    else
      expect_complaint(program.wait(), 1, {"stopped ("});
    expect_no_processes_with(out);
  }
}

TEST_F(Render, NamesTheFieldsThereAreWhenAskedForAnother) {
  expect_complaint(render({"--field", "temperature"}), 2,
                   {"'temperature'", "velocity", "mean_stress"});
  EXPECT_FALSE(fs::exists(*this / "pictures") && !fs::is_empty(*this / "pictures"));
}

TEST_F(Render, NamesTheComponentsThereAreWhenAskedForAnother) {
  const std::string tensor = "must be 0 (xx), 1 (yy), 2 (zz), 3 (xy), 4 (yz) or 5 (xz)";
  const std::string vector = "must be 0 (x), 1 (y), 2 (z) or -1 (magnitude)";
  expect_complaint(render({"--field", "stress", "--component", "7"}), 2,
                   {"--component: stress has no component 7; " + tensor});
  expect_complaint(render({"--field", "stress"}), 2,
                   {"--component: stress has no magnitude; " + tensor});
  expect_complaint(render({"--field", "velocity", "--component", "3"}), 2,
                   {"--component: velocity has no component 3; " + vector});
  expect_complaint(render({"--field", "velocity", "--component", "-2"}), 2,
                   {"--component: velocity has no component -2; " + vector});
  expect_complaint(render({"--component", "7"}), 2,
                   {"--component: equivalent_plastic_strain has no component 7; must be 0 or -1"});
  EXPECT_FALSE(fs::exists(*this / "pictures"));
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
