// What charts say, looked at as data.
#include "render/chart_panels.hpp"
#include "render/parity_chart.hpp"
#include "tests/support/drawing_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace scarp::render {

using test::area_of;
using test::expect_nothing_clipped;
using test::expect_words_apart;
using test::extent_of;
using test::says;
using test::words_of;

namespace {

/// A pulse of height `peak` at 6 s.
Curve pulse(const std::string& label, double peak) {
  Curve curve;
  curve.label = label;
  for (int i = 0; i <= 150; ++i) {
    const double t = 0.1 * i;
    curve.x.push_back(t);
    curve.y.push_back(peak * std::exp(-0.5 * std::pow((t - 6.0) / 1.3, 2)));
  }
  return curve;
}

ChartStyle history_style() {
  return {.x_name = "time", .x_unit = "s", .y_name = "energy", .y_unit = "kJ"};
}

/// Of as many curves as `values`; a larger value gives a lower curve.
Chart family(const std::vector<double>& values) {
  Chart chart = {{}, history_style()};
  for (const double value : values) {
    chart.curves.push_back(pulse("", 100.0 / value));
    chart.curves.back().parameter = value;
  }
  chart.style.parameter_name = "cohesion";
  chart.style.parameter_unit = "kPa";
  return chart;
}

std::vector<double> numbers(int from, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + i);
  return values;
}

} // namespace

TEST(Chart, SpansAreNamedAboveTheData) {
  ChartStyle style = history_style();
  style.spans = {{"I", {0.0, 4.0}}, {"II", {4.0, 6.0}}, {"III", {6.0, 10.0}}};
  const Curve curve = pulse("toe", 5.8);
  const Drawing drawing = draw_chart({curve}, style);
  const Box drawn = extent_of(drawing, palette::blue);
  double previous = 0.0;
  for (const char* const name : {"I", "II", "III"}) {
    const Box words = covered(words_of(drawing, name));
    EXPECT_GT(words.lower.y, drawn.upper.y) << name;
    EXPECT_GT(words.lower.x, previous) << name;
    previous = words.upper.x;
  }
  // Limits 4, 6 and 10 are lines; 0 is the axis.
  EXPECT_GT(extent_of(drawing, palette::grey).lower.x, drawn.lower.x);
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);

  style.spans = {{"never", {4.0, 4.0}}};
  EXPECT_THROW(draw_chart({curve}, style), std::invalid_argument);
}

TEST(Chart, SpansBeyondTheAxisAreLeftOut) {
  ChartStyle style = history_style();
  style.x_limits = Limits{3.0, 9.0};
  style.spans = {{"before", {0.0, 2.0}}, {"during", {2.0, 12.0}}};
  const Drawing drawing = draw_chart({pulse("", 1.0)}, style);
  EXPECT_FALSE(says(drawing, "before"));
  EXPECT_TRUE(says(drawing, "during"));
}

TEST(Chart, NotesEndTheLegend) {
  ChartStyle style = history_style();
  style.notes = {"R² = 0.98"};
  const Drawing drawing = draw_chart({pulse("toe", 1.0)}, style);
  EXPECT_LT(words_of(drawing, "R² = 0.98").position.y, words_of(drawing, "toe").position.y);
  EXPECT_TRUE(says(draw_chart({pulse("", 1.0)}, style), "R² = 0.98"));
}

TEST(Chart, WeightThinsTheLine) {
  Curve curve = pulse("", 1.0);
  const double usual = area_of(draw_chart({curve}, history_style()), palette::blue);
  curve.weight = 0.5;
  const double thin = area_of(draw_chart({curve}, history_style()), palette::blue);
  EXPECT_LT(thin, 0.6 * usual);
}

TEST(Chart, AFamilyHasOneColourAValueAndAKey) {
  const Chart few = family({196.0, 245.0, 294.0, 343.0});
  const Drawing drawing = draw_chart(few.curves, few.style);
  for (const char* const words : {"cohesion (kPa)", "196", "245", "294", "343"})
    EXPECT_TRUE(says(drawing, words)) << words;
  EXPECT_GT(area_of(drawing, colour_at(ColourMap::viridis, 0.0)), 0.0);
  // The largest value's curve is the lowest; its colour is the top of the key.
  EXPECT_GT(words_of(drawing, "343").position.y, words_of(drawing, "196").position.y);
}

TEST(Chart, TheKeyOfManyCurvesIsLegible) {
  for (const int count : {2, 11, 15, 40}) {
    const Chart chart = family(numbers(15, count));
    for (const int columns : {1, 3}) { // in a corner, and below
      const Drawing drawing = draw_chart_panels(std::vector<Chart>(3, chart), {.columns = columns});
      expect_nothing_clipped(drawing);
      expect_words_apart(drawing);
      EXPECT_TRUE(says(drawing, "15")) << count;
    }
  }
}

TEST(ChartPanels, HaveLettersAndPlotsOfOneSize) {
  std::vector<Chart> charts(3, {{pulse("toe", 1.0)}, history_style()});
  charts[0].style.title = "first";
  charts[2].curves = {pulse("toe", 12345.0)}; // wider numbers
  const Drawing drawing = draw_chart_panels(charts, {.columns = 2});
  const Point a = words_of(drawing, "a)  first").position;
  const Point b = words_of(drawing, "b)").position;
  const Point c = words_of(drawing, "c)").position;
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.x, c.x);
  EXPECT_LT(c.y, a.y);
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);
}

TEST(ChartPanels, ASharedLegendSaysEachLabelOnce) {
  const std::vector<Chart> charts(4,
                                  {{pulse("shoulder", 1.0), pulse("toe", 0.5)}, history_style()});
  const Drawing drawing = draw_chart_panels(charts, {.columns = 2, .shared_legend = true});
  EXPECT_EQ(std::count_if(drawing.texts.begin(), drawing.texts.end(),
                          [](const Words& words) { return words.text == "toe"; }),
            1);
  EXPECT_LT(words_of(drawing, "toe").position.y, words_of(drawing, "time (s)").position.y);
  EXPECT_EQ(words_of(drawing, "toe").position.y, words_of(drawing, "shoulder").position.y);
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);
}

TEST(ChartPanels, ASharedLegendIsReadColumnByColumn) {
  const std::vector<std::string> labels = {"first", "second", "third", "fourth",
                                           "fifth, the longest"};
  Chart chart = {{}, history_style()};
  for (const std::string& label : labels) chart.curves.push_back(pulse(label, 1.0));
  const Drawing drawing = draw_chart_panels({chart}, {.shared_legend = true, .width = 480});
  const auto place = [&](std::size_t entry) { return words_of(drawing, labels[entry]).position; };
  EXPECT_EQ(place(1).x, place(0).x);
  EXPECT_LT(place(1).y, place(0).y);
  EXPECT_GT(place(2).x, place(1).x);
  EXPECT_EQ(place(2).y, place(0).y);
  EXPECT_GT(place(4).x, place(3).x);
  EXPECT_EQ(place(4).y, place(0).y);
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);
}

TEST(ChartPanels, ASharedLegendEndsWithTheNotesThatAllChartsHave) {
  std::vector<Chart> charts(2, {{pulse("shoulder", 1.0), pulse("toe", 0.5)}, history_style()});
  for (Chart& chart : charts) chart.style.notes = {"smoothed"};
  const auto times_said = [](const Drawing& drawing) {
    return std::ranges::count(drawing.texts, "smoothed", &Words::text);
  };
  const Drawing common = draw_chart_panels(charts, {.shared_legend = true});
  EXPECT_EQ(times_said(common), 1);
  EXPECT_LT(words_of(common, "smoothed").position.y, words_of(common, "toe").position.y);
  expect_nothing_clipped(common);
  expect_words_apart(common);
  EXPECT_EQ(times_said(draw_chart_panels(charts, {})), 2);
  charts[1].style.notes = {"raw"};
  const Drawing own = draw_chart_panels(charts, {.shared_legend = true});
  EXPECT_GT(words_of(own, "smoothed").position.y, words_of(own, "toe").position.y);
  EXPECT_GT(words_of(own, "raw").position.y, words_of(own, "toe").position.y);
}

TEST(ChartPanels, NothingIsClippedAtAnySize) {
  const std::vector<Chart> charts = {family(numbers(15, 15)),
                                     {{pulse("a rather long label", 3.0)}, history_style()}};
  for (const int width : {480, 1000, 1920, 3000}) {
    for (const int columns : {1, 2}) {
      const Drawing drawing = draw_chart_panels(charts, {.columns = columns, .width = width});
      expect_nothing_clipped(drawing);
      expect_words_apart(drawing);
    }
  }
}

TEST(ChartPanels, RefuseWhatMakesNoPicture) {
  EXPECT_THROW(draw_chart_panels({}, {}), std::invalid_argument);
  const std::vector<Chart> charts = {{{pulse("", 1.0)}, history_style()}};
  EXPECT_THROW(draw_chart_panels(charts, {.columns = 0}), std::invalid_argument);
  EXPECT_THROW(draw_chart_panels(charts, {.height = 40}), std::invalid_argument);
}

TEST(Parity, AxesAreEqualAndRound) {
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const Chart chart = parity_chart({10.0, 28.0, gap}, {8.0, 26.0, 1.0},
                                   {.quantity = "run-out",
                                    .unit = "m",
                                    .reference = "paper",
                                    .tolerance = 0.05,
                                    .notes = {"R² = 0.98"}});
  EXPECT_EQ(chart.style.x_limits->lower, 0.0);
  EXPECT_EQ(chart.style.x_limits->upper, 30.0);
  EXPECT_EQ(chart.style.y_limits->upper, 30.0);
  const Drawing drawing = draw_chart(chart.curves, chart.style);
  for (const char* const words :
       {"run-out", "paper (m)", "scarp (m)", "1 : 1", "±5 %", "R² = 0.98"})
    EXPECT_TRUE(says(drawing, words)) << words;
  const Box dots = extent_of(drawing, palette::blue);
  EXPECT_NEAR(dots.width(), dots.height(), 1.0); // 18 m by 18 m
  expect_nothing_clipped(drawing);
  expect_words_apart(drawing);
}

TEST(Parity, ResidualsStandAroundZero) {
  const Chart chart = residual_chart({1.0, 2.0, 3.0}, {0.1, -0.4, 0.2},
                                     {.quantity = "peak velocity", .unit = "m/s"});
  EXPECT_NEAR(chart.style.y_limits->lower, -chart.style.y_limits->upper, 1e-12);
  EXPECT_GT(chart.style.y_limits->upper, 0.4);
  const Drawing drawing = draw_chart(chart.curves, chart.style);
  EXPECT_TRUE(says(drawing, "fitted value (m/s)"));
  EXPECT_TRUE(says(drawing, "residual (m/s)"));
}

} // namespace scarp::render
