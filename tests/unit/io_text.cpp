#include "io/polygon.hpp"
#include "io/text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <utility>

using namespace scarp::io;

TEST(Text, NumbersReadBackExactly) {
  EXPECT_EQ(number_text(0.0025), "0.0025");
  EXPECT_EQ(number_text(700000.0), "700000");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.30000000000000004");
  for (const double value : {1.0 / 3.0, -5e-324, 1.7976931348623157e308, 1e16, 123456789012.5})
    EXPECT_EQ(parse_number(number_text(value)), value);
  EXPECT_EQ(parse_number(number_text(-std::numeric_limits<double>::infinity())),
            -std::numeric_limits<double>::infinity());
}

TEST(Text, DidYouMean) {
  const std::vector<std::string> words = {"musl", "usl", "cell_size_m", "lower_m"};
  EXPECT_EQ(closest("muls", words), "musl");              // neighbours swapped
  EXPECT_EQ(closest("usk", words), "usl");                // replaced
  EXPECT_EQ(closest("cel_size_m", words), "cell_size_m"); // left out
  EXPECT_EQ(closest("lower", words), "lower_m");          // no unit
  EXPECT_EQ(closest("viscosity", words), "");
  EXPECT_EQ(closest("", words), "");
  EXPECT_EQ(did_you_mean("muls", words), "did you mean 'musl'?");
  EXPECT_EQ(did_you_mean("viscosity", words), "");
}

TEST(Text, Lists) {
  EXPECT_EQ(quoted_list({"a"}, "or"), "'a'");
  EXPECT_EQ(quoted_list({"a", "b"}, "or"), "'a' or 'b'");
  EXPECT_EQ(quoted_list({"a", "b", "c"}, "and"), "'a', 'b' and 'c'");
}

TEST(Polygon, Area) {
  EXPECT_DOUBLE_EQ(area({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), 2.0);
  EXPECT_DOUBLE_EQ(area({{0, 1}, {2, 1}, {2, 0}, {0, 0}}), 2.0); // the other way round
  EXPECT_DOUBLE_EQ(area({{0, 0}, {2, 0}, {1, 0.5}, {2, 1}, {0, 1}}), 1.5);
}

TEST(Polygon, FlatOnes) {
  EXPECT_TRUE(is_flat({{0, 0}, {1, 1}, {2, 2}}));
  EXPECT_TRUE(is_flat({{1, 1}, {1, 1}, {1, 1}}));
  EXPECT_FALSE(is_flat({{0, 0}, {1, 1}, {2, 2.001}}));
}

TEST(Polygon, CrossingEdges) {
  using Edges = std::optional<std::pair<std::size_t, std::size_t>>;
  EXPECT_EQ(crossing_edges({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), Edges());
  EXPECT_EQ(crossing_edges({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}), Edges()); // straight corner
  EXPECT_EQ(crossing_edges({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), Edges({0, 2}));   // bow tie
  EXPECT_EQ(crossing_edges({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}), Edges({0, 2})); // touches
  EXPECT_EQ(crossing_edges({{0, 0}, {2, 0}, {1, 0}, {1, 1}}), Edges({0, 1}));         // folds back
}
