// Verification cases: the derivations behind them, and what they make of a result.
#include "apps/bench/accuracy.hpp"
#include "apps/bench/charts.hpp"
#include "apps/bench/extrapolation.hpp"
#include "apps/bench/footing.hpp"
#include "apps/bench/pile.hpp"
#include "apps/bench/slope.hpp"
#include "apps/bench/vortex.hpp"

#include "core/stress_pass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <stdexcept>

using namespace scarp;
using namespace scarp::bench;

namespace {

Check check(double value, double reference, double bound, Bound kind) {
  return {"name", value, reference, bound, kind, "-", "source"};
}

/// 5 + 3 h^order on cells that halve.
std::vector<double> falling(const std::vector<double>& cell_size, double order) {
  std::vector<double> answer;
  answer.reserve(cell_size.size());
  for (const double h : cell_size) answer.push_back(5.0 + 3.0 * std::pow(h, order));
  return answer;
}

/// Scenes and references are read where the sources are.
class BenchScenes : public testing::Test {
 protected:
  static void SetUpTestSuite() { setenv("SCARP_DATA", SCARP_SOURCE_DIR "/data", 1); }

  static Discretisation accurate() {
    Discretisation how;
    how.method = method_of(Preset::accurate);
    return how;
  }
};

} // namespace

TEST(BenchReport, BoundsAreKept) {
  EXPECT_TRUE(check(1.04, 1.0, 0.05, Bound::relative).pass());
  EXPECT_FALSE(check(1.06, 1.0, 0.05, Bound::relative).pass());
  EXPECT_TRUE(check(-1.04, -1.0, 0.05, Bound::relative).pass());
  EXPECT_FALSE(check(0.06, 0.0, 0.05, Bound::absolute).pass());
  EXPECT_TRUE(check(1.8, 2.0, 1.8, Bound::at_least).pass());
  EXPECT_FALSE(check(1.79, 2.0, 1.8, Bound::at_least).pass());
  EXPECT_FALSE(check(2.1, 0.0, 2.0, Bound::at_most).pass());
  for (const Bound kind : {Bound::relative, Bound::absolute, Bound::at_least, Bound::at_most})
    EXPECT_FALSE(check(std::nan(""), 0.0, 1.0, kind).pass());
}

TEST(BenchReport, OrderIsTheSlope) {
  const Convergence quadratic = {"", {0.1, 0.2, 0.4}, {0.03, 0.12, 0.48}};
  EXPECT_NEAR(quadratic.order(), 2.0, 1e-12);
}

TEST(BenchReport, LogarithmicAxesHaveRoundNumbers) {
  render::Chart chart;
  chart.curves = {{.label = "", .x = {0.01, 0.1}, .y = {1e-4, 1e-8}},
                  {.label = "", .x = {0.0}, .y = {1.0}}};
  const render::Chart logarithmic = log_log(chart);
  EXPECT_NEAR(logarithmic.curves[0].x[0], -2.0, 1e-12);
  EXPECT_TRUE(std::isnan(logarithmic.curves[1].x[0]));
  ASSERT_FALSE(logarithmic.style.y_ticks.empty());
  EXPECT_EQ(logarithmic.style.y_ticks.front().label, "10⁻⁸");
  EXPECT_EQ(logarithmic.style.x_ticks.front().label, "0.01");
}

TEST(BenchReport, NamesAreUnique) {
  const std::vector<std::string> all = names();
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
}

/// rho a = div(sigma) + rho b at a place in the ring, with the motion's second derivative in time
/// and the stress's divergence taken by differences.
TEST(BenchVortex, ForceBalances) {
  const Vortex vortex;
  constexpr double density = 1000.0, time = 0.3, step = 1e-4;
  const std::array<double, 3> from = {0.7, 0.0, 0.45};
  const auto at = [&](double t) { return vortex.position(from, t); };
  const std::array<double, 3> x = at(time);
  const double radius = std::hypot(x[0], x[2]);
  const double c = x[0] / radius, s = x[2] / radius;
  const auto a = [&](std::size_t i) {
    return (at(time + step)[i] - 2.0 * x[i] + at(time - step)[i]) / (step * step);
  };
  const double a_r = c * a(0) + s * a(2), a_t = c * a(2) - s * a(0);
  const std::array<double, 3> sigma = vortex.stress(radius, time);
  const auto d_sigma = [&](std::size_t i) {
    return (vortex.stress(radius + step, time)[i] - vortex.stress(radius - step, time)[i]) /
           (2.0 * step);
  };
  const std::array<double, 3> b = vortex.force(x, time);
  const double b_r = c * b[0] + s * b[2], b_t = c * b[2] - s * b[0];
  EXPECT_NEAR(density * (a_r - b_r), d_sigma(0) + (sigma[0] - sigma[1]) / radius, 0.5);
  EXPECT_NEAR(density * (a_t - b_t), d_sigma(2) + 2.0 * sigma[2] / radius, 0.5);
  EXPECT_GT(std::abs(d_sigma(2)), 30.0) << "there is something to balance";
}

/// The stress of the closed form is what the solver's own update gives along the motion of a point.
TEST(BenchVortex, StressFollowsTheJaumannLaw) {
  const Vortex vortex;
  constexpr double radius = 0.75, G = 1000.0 / 2.6, step = 1e-6;
  const auto gamma_of = [&](double t) { // R d(alpha)/dR by differences
    const auto angle = [&](double r) {
      const auto x = vortex.position({r, 0.0, 0.0}, t);
      return std::atan2(x[2], x[0]);
    };
    return radius * (angle(radius + step) - angle(radius - step)) / (2.0 * step);
  };
  // In axes that turn with the point: the shear, and the spin relative to them.
  SymTensor<2> tau = {};
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    const double d = gamma_of(0.5 * (i + 1) / steps) - gamma_of(0.5 * i / steps);
    update_stress<2>(tau, {{{0.0, 0.0}, {d, 0.0}}}, 1.0, ElasticModuli::from(1000.0, 0.3),
                     ElasticUpdate{});
  }
  const std::array<double, 3> exact = vortex.stress(radius, 0.5);
  EXPECT_NEAR(tau[0], exact[0], 2e-3 * G);
  EXPECT_NEAR(tau[1], exact[1], 2e-3 * G);
  EXPECT_NEAR(tau[3], exact[2], 2e-3 * G);
  EXPECT_GT(std::abs(exact[2]), 0.5 * G);
}

TEST(BenchVortex, ErrorFallsWithTheCells) {
  Discretisation how;
  how.method.shape = ShapeFunctions::bspline;
  const VortexRun coarse = run_vortex({}, 8, how);
  how.cfl = 0.15;
  const VortexRun fine = run_vortex({}, 16, how);
  EXPECT_LT(fine.error, 0.35 * coarse.error); // measured 0.295
  EXPECT_LT(fine.stress_error, 0.4 * coarse.stress_error);
}

TEST(BenchFooting, ReachesItsLimitLoad) {
  Discretisation how;
  how.method.flip = 0.99;
  how.method.volume_rate = VolumeRate::cell_average;
  const FootingRun run = press_footing(8, how);
  EXPECT_NEAR(run.limit(), prandtl, 0.1 * prandtl); // measured + 8.4 %
  EXPECT_NEAR(run.growth(), 0.0, 0.02);
  EXPECT_LT(run.pressure.front(), 1.0);
}

/// The cheap cases whole.
TEST(BenchCases, CheapOnesPass) {
  for (const Case& one : cases()) {
    if (!std::set<std::string>{"bar", "column", "stress-paths", "rotation", "block", "conservation"}
             .contains(one.name))
      continue;
    SCOPED_TRACE(one.name);
    const CaseReport report = one.run(Effort::quick);
    EXPECT_FALSE(report.checks.empty());
    EXPECT_FALSE(report.figure.empty());
    for (const Check& done : report.checks)
      EXPECT_TRUE(done.pass()) << done.name << " " << done.value;
  }
}

TEST(BenchWork, MethodsHaveErrorsAndCosts) {
  const WorkScene& bar = work_scenes().front();
  const WorkResult result = run_work(bar, Effort::quick, [](const WorkRun&) {});
  ASSERT_FALSE(result.runs.empty());
  for (const WorkRun& run : result.runs) {
    EXPECT_TRUE(run.failure.empty()) << run.method;
    EXPECT_GT(run.outcome.error, 0.0) << run.method;
    EXPECT_GT(run.point_steps(), 0.0) << run.method;
  }
  EXPECT_EQ(work_figure(result).size(), 2U);
  const auto record = to_json(result.runs.front());
  for (const char* key : {"scene", "method", "cell_size", "points_per_cell", "cfl", "error",
                          "wall_s", "point_steps", "points", "steps"})
    EXPECT_TRUE(record.contains(key)) << key;
}

TEST(BenchExtrapolation, FindsLimitAndOrder) {
  const std::vector<double> h = {8.0, 2.0, 1.0, 0.5};
  for (const double order : {0.5, 1.0, 2.0}) {
    const std::vector<double> answer = falling(h, order);
    const Extrapolation found = extrapolate(h, answer);
    EXPECT_EQ(found.course, Course::converges);
    EXPECT_NEAR(found.value, 5.0, 1e-12);
    EXPECT_NEAR(found.order, order, 1e-12);
    EXPECT_NEAR(found.bar, 1.25 * (answer.back() - 5.0), 1e-12);
  }
}

TEST(BenchExtrapolation, HasNoValueWithoutConvergence) {
  const std::vector<double> h = {2.0, 1.0, 0.5};
  for (const auto& [answer, course] :
       std::vector<std::pair<std::vector<double>, Course>>{{{1.0, 2.0, 4.0}, Course::diverges},
                                                           {{1.0, 2.0, 3.0}, Course::diverges},
                                                           {{1.0, 1.0, 1.0}, Course::diverges},
                                                           {{1.0, 2.0, 1.5}, Course::oscillates}}) {
    const Extrapolation found = extrapolate(h, answer);
    EXPECT_EQ(found.course, course);
    EXPECT_TRUE(std::isnan(found.value) && std::isnan(found.order) && std::isnan(found.bar));
    EXPECT_NE(to_text(found).find("no value"), std::string::npos);
  }
  EXPECT_THROW(extrapolate({2.0, 1.0}, {1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(extrapolate({2.0, 1.0, 0.4}, {1.0, 2.0, 2.5}), std::invalid_argument);
  EXPECT_THROW(extrapolate({0.5, 1.0, 2.0}, {1.0, 2.0, 2.5}), std::invalid_argument);
}

/// 5 + 3 h^2, in the second number something else.
TEST(BenchConverged, ErrorsToTheExtrapolatedValueHaveBars) {
  const Converged found =
      to_extrapolated({1.0, 0.5, 0.25}, {{8.0, 1.0}, {5.75, 7.0}, {5.1875, 0.0}});
  ASSERT_TRUE(found.value);
  EXPECT_NEAR(*found.value, 5.0, 1e-12);
  ASSERT_EQ(found.errors.size(), 3U);
  EXPECT_NEAR(found.errors[0].error, 3.0 / 5.0, 1e-12);
  const double bar = 1.25 * 0.1875 / 5.0;
  EXPECT_NEAR(found.errors[0].lower, 3.0 / 5.0 - bar, 1e-12);
  EXPECT_NEAR(found.errors[0].upper, 3.0 / 5.0 + bar, 1e-12);
  EXPECT_EQ(found.errors[2].lower, 0.0) << "the bar is wider than the error";
}

TEST(BenchConverged, WithoutAValueErrorsAreAtLeastWhatRunsDifferBy) {
  for (const Answers& answers : {Answers{{1.0}, {2.0}, {4.0}}, Answers{{2.0}, {4.0}}}) {
    std::vector<double> h = {2.0, 1.0, 0.5};
    h.resize(answers.size());
    const Converged found = to_extrapolated(h, answers);
    EXPECT_FALSE(found.value);
    EXPECT_NE(found.verdict.find("no value"), std::string::npos);
    const ConvergedError last_but_one = found.errors.at(found.errors.size() - 2);
    EXPECT_NEAR(last_but_one.error, 0.5, 1e-12);
    EXPECT_TRUE(std::isinf(last_but_one.upper));
    EXPECT_TRUE(std::isnan(found.errors.back().error));
  }
}

TEST(BenchConverged, ARunIsMissing) {
  const Converged found = to_extrapolated({2.0, 0.5, 0.25}, {{1.0}, {1.5}, {1.75}});
  EXPECT_FALSE(found.value);
  EXPECT_NE(found.verdict.find("one factor"), std::string::npos);
  EXPECT_TRUE(to_extrapolated({}, {}).errors.empty());
  EXPECT_TRUE(to_finest({}, {}).errors.empty());
}

TEST(BenchConverged, TheFinestRunStandsForIt) {
  const Converged found = to_finest({2.0, 1.0}, {{1.0, 5.0}, {1.0, 1.0}});
  EXPECT_NEAR(found.errors[0].error, std::sqrt(8.0), 1e-12);
  EXPECT_TRUE(std::isnan(found.errors[1].error));
}

TEST_F(BenchScenes, PileComesDown) {
  const PileRun run = collapse_pile(10, accurate());
  EXPECT_EQ(run.points, 800U);
  EXPECT_EQ(run.surface.size(), 23U);
  EXPECT_LT(run.error, 0.1 * pile_height);
  EXPECT_LT(run.surface.front(), 1.05 * pile_height);
  EXPECT_LT(run.surface.back(), 0.2 * pile_height);
}

TEST_F(BenchScenes, SlopeSlides) {
  const SlopeRun run = slide_slope(60, accurate());
  EXPECT_EQ(run.points, 2750U);
  EXPECT_GT(run.peak_energy, 1e6); // 2.28 MJ measured, 3.6 MJ in the paper with 1 m cells
  EXPECT_LT(run.peak_energy, 5e6);
  EXPECT_GT(run.run_out, 5.0);
  EXPECT_LT(run.run_out, 20.0);
}

TEST_F(BenchScenes, ErrorsToTheConvergedSolutionKeepTheRuns) {
  const auto pile = std::ranges::find(work_scenes(), "work-pile", &WorkScene::name);
  WorkResult made;
  made.origin = &*pile;
  for (const double h : {0.01, 0.005}) {
    made.runs.push_back({"work-pile", "linear", {}, h, {0.1, 1, 1, {h, 2.0 * h}}, {}, 1.0});
    made.runs.push_back({"work-pile", "linear", {}, h, {}, "stopped", 1.0});
  }
  made.runs.push_back({"work-pile", "B-spline", {}, 0.01, {}, "stopped", 1.0});
  const WorkResult converged = converged_work(made);
  ASSERT_EQ(converged.runs.size(), made.runs.size());
  EXPECT_EQ(converged.verdicts.size(), 2U);
  EXPECT_NEAR(converged.runs[0].outcome.error, 0.005 * std::sqrt(2.5), 1e-12);
  EXPECT_EQ(converged.runs[0].scene, "work-pile-converged");
  EXPECT_FALSE(converged.runs[1].converged);
  EXPECT_TRUE(to_json(converged.runs[0]).contains("error_between"));
  EXPECT_EQ(work_figure(converged).size(), 2U);
}
