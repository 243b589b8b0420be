// What the program says to a command line or a scene, right or wrong.
#include "tests/end_to_end/program.hpp"

#include <fstream>

namespace scarp::test {

using CommandLine = EndToEnd;

TEST_F(CommandLine, HelpOfEveryCommandIsNoError) {
  const std::vector<std::vector<std::string>> commands = {
      {},       {"run"},     {"render"}, {"reproduce"}, {"reproduce", "bui2008"},
      {"info"}, {"options"}, {"study"},  {"safety"}};
  for (std::vector<std::string> words : commands) {
    words.emplace_back("--help");
    const Result result = scarp(words);
    SCOPED_TRACE(words.front());
    expect_success(result);
    EXPECT_NE(result.out.find("Usage: scarp"), std::string::npos) << result.out;
  }
}

TEST_F(CommandLine, WithoutACommandOrWithAnUnknownOptionIsAMistakeOfTheUser) {
  const std::vector<std::vector<std::string>> mistakes = {
      {},
      {"--bogus"},
      {"bogus"},
      {"run"},
      {"run", "block.toml"}, // --out is missing
      {"run", "block.toml", "--out", "out", "--bogus"},
      {"run", "block.toml", "--out", "out", "--threads", "0"},
      {"run", "block.toml", "--out", "out", "more"},
      {"render", "out", "--width", "wide"},
      {"render", "out", "--colours", "rainbow"},
      {"reproduce"},
      {"reproduce", "bogus", "--out", "out"}};
  for (const std::vector<std::string>& words : mistakes) {
    const Result result = scarp(words);
    SCOPED_TRACE(testing::PrintToString(words));
    expect_complaint(result, 2, {"--help says more"});
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(*this / "out"));
  }
  expect_complaint(scarp({"rnu"}), 2, {"'rnu' is unknown", "'render'", "did you mean 'run'?"});
  expect_complaint(scarp({"reproduce"}), 2, {"a command is missing", "'bui2008'"});
  expect_complaint(scarp({"run"}), 2, {"scene is required", "scarp run --help"});
}

TEST_F(CommandLine, EveryProblemOfASceneIsALineAndNothingIsWritten) {
  std::string text = small_scene;
  text.replace(text.find("cell_size_m = 0.01"), 18, "cel_size_m = 0.01 ");
  text.replace(text.find("poissons_ratio = 0.3"), 20, "poissons_ratio = 0.7");
  text.replace(text.find("material = \"rods\""), 17, "material = \"road\"");
  write_scene(text);
  for (const char* command : {"run", "info"}) {
    std::vector<std::string> words = {command, "block.toml"};
    if (words.front() == "run") words.insert(words.end(), {"--out", "out"});
    const Result result = scarp(words);
    SCOPED_TRACE(command);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    // The misspelt key is missing and unknown; ratio and material are one each.
    EXPECT_EQ(lines_of(result.err).size(), 4U) << result.err;
    for (const char* words_of_it : {"grid.cell_size_m: is missing", "did you mean",
                                    "block.toml:21:18: material.rods.poissons_ratio: is 0.7",
                                    "block.toml:27:12: region.block.material: is 'road'"})
      EXPECT_NE(result.err.find(words_of_it), std::string::npos)
          << "'" << words_of_it << "' is not in: " << result.err;
  }
  EXPECT_EQ(names_in(directory_), std::vector<std::string>{"block.toml"});
}

TEST_F(CommandLine, AWrongOverrideIsNamedAsItWasGiven) {
  expect_complaint(scarp({"run", "block.toml", "--out", "out", "--set", "method.flip=2"}), 2,
                   {"--set method.flip=2", "is 2"});
  expect_complaint(scarp({"run", "nowhere.toml", "--out", "out"}), 2, {"nowhere.toml"});
  EXPECT_EQ(names_in(directory_), std::vector<std::string>{"block.toml"});
}

TEST_F(CommandLine, AFileInThePlaceOfTheResultsIsLeftAlone) {
  std::ofstream(*this / "out") << "mine";
  for (const char* out : {"out", "out/below"}) {
    expect_complaint(scarp({"run", "block.toml", "--out", out}), 2,
                     {std::string("--out ") + out, "Not a directory"});
    expect_complaint(scarp({"reproduce", "bui2008", "--cell", "0.005", "--out", out}), 2,
                     {std::string("--out ") + out, "Not a directory"});
  }
  EXPECT_EQ(content(*this / "out"), "mine");
}

TEST_F(CommandLine, InfoTellsSizeAndCost) {
  const Result result = scarp({"info", "block.toml"});
  expect_success(result);
  EXPECT_EQ(lines_of(result.out).front(), "A block of rods is let go");
  for (const char* line : {"\n  points          400\n", "\n  cells           100 of 450\n",
                           "\n  first step ", "\n  run time "})
    EXPECT_NE(result.out.find(line), std::string::npos) << line << " is not in:\n" << result.out;
  EXPECT_EQ(names_in(directory_), std::vector<std::string>{"block.toml"});
}

/// What `info --all` prints is a scene: read again, it prints the same.
TEST_F(CommandLine, InfoPrintsEveryValueAsASceneThatMeansTheSame) {
  const Result first = scarp({"info", "block.toml", "--all", "--set", "method.flip=0.875"});
  expect_success(first);
  EXPECT_NE(first.out.find("0.875"), std::string::npos) << first.out;
  write_scene(first.out);
  const Result second = scarp({"info", "block.toml", "--all"});
  expect_success(second);
  EXPECT_EQ(first.out, second.out);
}

TEST_F(CommandLine, TheManualsAreThoseInTheData) {
  const Result result = scarp({"options"});
  expect_success(result);
  EXPECT_EQ(result.out, content(fs::path(SCARP_DATA_DIR) / "scene_reference.md"));
  const Result study = scarp({"options", "--study"});
  expect_success(study);
  EXPECT_EQ(study.out, content(fs::path(SCARP_DATA_DIR) / "study_reference.md"));
}

} // namespace scarp::test
