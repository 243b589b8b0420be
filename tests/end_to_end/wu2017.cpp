// scarp reproduce wu2017 in coarse cells (440 points a run), and its page in a real browser.
#include "tests/end_to_end/program.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace scarp::test {

using Wu2017 = EndToEnd;

namespace {

const std::vector<std::string> coarse = {"reproduce", "wu2017",
                                         "--out",     "out",
                                         "--set",     "grid.cell_size_m=2.5",
                                         "--set",     "grid.points_per_cell=1"};

/// What a shell command prints.
std::string printed(const std::string& command) {
  std::string text;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::array<char, 4096> buffer;
  std::size_t got = 0;
  while (pipe && (got = std::fread(buffer.data(), 1, buffer.size(), pipe.get())) > 0)
    text.append(buffer.data(), got);
  return text;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

} // namespace

/// One run for all of it; the second call finds everything done.
TEST_F(Wu2017, MakesTheFiguresTheTablesAndThePage) {
  const Result result = scarp(coarse);
  expect_success(result);
  for (const char* words : {"Table 1: paper / scarp", "Regressions on scarp's table", "E = "})
    EXPECT_NE(result.out.find(words), std::string::npos) << words;

  const auto summary = nlohmann::json::parse(content(*this / "out/summary.json"));
  EXPECT_EQ(summary.at("points"), summary.at("points").get<int>());
  EXPECT_EQ(summary.at("failed_scenarios"), 0);
  ASSERT_EQ(summary.at("scenarios").size(), 29U);
  for (const auto& scenario : summary.at("scenarios"))
    for (const char* key :
         {"peak_velocity_m_s", "peak_acceleration_m_s2", "runout_m", "peak_kinetic_energy_kJ"}) {
      EXPECT_TRUE(scenario.at("paper").at(key).is_number()) << key;
      EXPECT_GT(scenario.at("scarp").at(key).get<double>(), 0.0) << key;
    }
  // The paper's own table gives the paper's own coefficients (eq. 27, reference: Wu 2017).
  const auto& paper = summary.at("regressions_of_paper").at("peak_kinetic_energy");
  EXPECT_NEAR(paper.at("b0").get<double>(), 15490, 5);
  EXPECT_NEAR(paper.at("phi").get<double>(), -533.6, 0.05);
  EXPECT_NEAR(paper.at("r2").get<double>(), 0.991, 0.0005);
  // What a coarse grid keeps: more load gives more energy and a longer way.
  const auto& own = summary.at("regressions");
  for (const char* what : {"peak_velocity", "peak_acceleration", "runout", "peak_kinetic_energy"})
    EXPECT_TRUE(own.contains(what)) << what;
  EXPECT_GT(own.at("peak_kinetic_energy").at("p").get<double>(), 0.0);
  EXPECT_LT(own.at("runout").at("phi").get<double>(), 0.0);
  EXPECT_EQ(lines_of(content(*this / "out/results.csv")).size(), 30U);

  for (const char* picture :
       {"figure6_points.png", "figure7_model.png", "figure8_loading.png",
        "figure9_initial_stress.png", "figure10_plastic_strain.png", "figure11_velocities.png",
        "figure12_kinetic_energy.png", "parity.png", "residuals.png"})
    EXPECT_GE(png_size(*this / "out" / picture).width, 1000U) << picture;

  const auto before = fs::last_write_time(*this / "out/scenarios/17/run.json");
  expect_success(scarp(coarse));
  EXPECT_EQ(fs::last_write_time(*this / "out/scenarios/17/run.json"), before);

  // A page of its own: no address, no script.
  const std::string page = content(*this / "out/index.html");
  for (const char* foreign : {"http://", "https://", "<script", "@import", "<link"})
    EXPECT_EQ(count(page, foreign), 0U) << foreign;
  EXPECT_EQ(count(page, "<img "), 9U);
  EXPECT_EQ(count(page, "src=\"data:image/png;base64,"), 9U);

  if (printed("command -v chromium").empty()) GTEST_SKIP() << "no chromium for the page";
  // As a phone shows it: the page itself is no wider than the screen, every picture has loaded.
  const std::string probe =
      "<script>addEventListener('load',()=>{const i=[...document.images];"
      "document.title='loaded '+i.filter(x=>x.complete&&x.naturalWidth>300).length+"
      "' wide '+(document.documentElement.scrollWidth>innerWidth)})</script>";
  const fs::path probed = *this / "out/probed.html";
  std::FILE* file = std::fopen(probed.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs((page + probe).c_str(), file);
  std::fclose(file);
  const std::string dom =
      printed("chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
              "--disable-background-networking --disable-component-update --disable-sync "
              "--user-data-dir=" +
              (*this / "profile").string() +
              " --window-size=500,900 --virtual-time-budget=5000 --dump-dom file://" +
              probed.string() + " 2>/dev/null");
  EXPECT_NE(dom.find("<title>loaded 9 wide false</title>"), std::string::npos)
      << dom.substr(dom.find("<title>"), 100);
}

TEST_F(Wu2017, RefusesWhatTheSceneDoesNotHave) {
  expect_complaint(scarp({"reproduce", "wu2017", "--out", "out", "--set", "grid.cell=1"}), 2,
                   {"grid.cell", "is unknown"});
  EXPECT_FALSE(fs::exists(*this / "out"));
}

} // namespace scarp::test
