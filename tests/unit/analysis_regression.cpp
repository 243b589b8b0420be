#include "core/analysis/regression.hpp"
#include "io/table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <string>

using namespace scarp;
using scarp::analysis::regress;
using scarp::analysis::Regression;

namespace {

std::string regression_error(const std::vector<std::vector<double>>& predictors,
                             const std::vector<double>& response) {
  try {
    regress(predictors, response);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no exception";
}

} // namespace

/// Wu et al. 2017, table 1: what least squares over its 29 rows gives, as an independent program
/// found it, to the digits quoted (half of the last one is the tolerance).  The paper's own R2
/// (equations 24-27): 0.92, 0.98, 0.99, 0.99.
TEST(Regression, OfWusTable) {
  struct Row {
    std::string response;
    std::array<double, 4> coefficients, half_digits;
    double r2;
  };
  const std::array<Row, 4> rows{{
      {"peak_velocity_m_s",
       {10.69, -0.09526, -0.3467, 0.006533},
       {0.005, 0.000005, 0.00005, 0.0000005},
       0.931},
      {"peak_acceleration_m_s2",
       {4.188, -0.05372, -0.1337, 0.003775},
       {0.0005, 0.000005, 0.00005, 0.0000005},
       0.984},
      {"runout_m", {65.42, -0.9963, -1.818, 0.06095}, {0.005, 0.00005, 0.0005, 0.000005}, 0.993},
      {"peak_kinetic_energy_kJ", {15490.0, -242.6, -533.6, 21.76}, {5.0, 0.05, 0.05, 0.005}, 0.991},
  }};
  const io::Table table =
      io::read_table(std::filesystem::path(SCARP_SOURCE_DIR) / "data/reference/wu2017_table1.csv");
  const std::vector<std::vector<double>> predictors{table.column("cohesion_kPa"),
                                                    table.column("friction_angle_deg"),
                                                    table.column("surcharge_kPa")};
  for (const Row& row : rows) {
    const std::vector<double>& response = table.column(row.response);
    const Regression fit = regress(predictors, response);
    ASSERT_EQ(fit.coefficients.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(fit.coefficients[i], row.coefficients[i], row.half_digits[i]) << row.response;
    EXPECT_NEAR(fit.r2, row.r2, 0.0005) << row.response;

    // What least squares leaves is orthogonal to the constant and to every predictor.
    const double size =
        std::sqrt(std::inner_product(response.begin(), response.end(), response.begin(), 0.0));
    EXPECT_NEAR(std::accumulate(fit.residuals.begin(), fit.residuals.end(), 0.0), 0.0,
                1e-12 * size);
    for (const std::vector<double>& x : predictors)
      EXPECT_NEAR(std::inner_product(x.begin(), x.end(), fit.residuals.begin(), 0.0), 0.0,
                  1e-10 * size)
          << row.response;
  }
}

/// y = (1, 3, 2, 5) at x = (0, 1, 2, 3), by hand: Sxx = 5, Sxy = 5.5, so y = 1.1 + 1.1 x; residuals
/// -0.1, 0.8, -1.3, 0.6 with the sum of squares 2.7 of 8.75, so s^2 = 2.7 / 2; s(b1)^2 = s^2 / Sxx,
/// s(b0)^2 = s^2 (1/4 + 1.5^2 / Sxx).
TEST(Regression, WorkedByHand) {
  const Regression fit = regress({{0.0, 1.0, 2.0, 3.0}}, {1.0, 3.0, 2.0, 5.0});
  const std::array<double, 4> residuals{-0.1, 0.8, -1.3, 0.6};
  ASSERT_EQ(fit.coefficients.size(), 2U);
  EXPECT_NEAR(fit.coefficients[0], 1.1, 1e-14);
  EXPECT_NEAR(fit.coefficients[1], 1.1, 1e-14);
  ASSERT_EQ(fit.standard_errors.size(), 2U);
  EXPECT_NEAR(fit.standard_errors[0], std::sqrt(1.35 * 0.7), 1e-14);
  EXPECT_NEAR(fit.standard_errors[1], std::sqrt(1.35 / 5.0), 1e-14);
  ASSERT_EQ(fit.residuals.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(fit.residuals[i], residuals[i], 1e-14);
  EXPECT_NEAR(fit.residual_deviation, std::sqrt(1.35), 1e-14);
  EXPECT_NEAR(fit.r2, 1.0 - 2.7 / 8.75, 1e-14);
}

/// A predictor in other units has its coefficient and error in them, and nothing else changes.
TEST(Regression, UnitsDoNotMatter) {
  const std::vector<double> x{0.0, 1.0, 2.0, 3.0}, y{1.0, 3.0, 2.0, 5.0}, z{2.0, -1.0, 0.5, 0.0};
  std::vector<double> small;
  for (const double value : x) small.push_back(1e-15 * value);
  const Regression expected = regress({x, z}, y), fit = regress({small, z}, y);
  EXPECT_NEAR(1e-15 * fit.coefficients[1], expected.coefficients[1], 1e-12);
  EXPECT_NEAR(1e-15 * fit.standard_errors[1], expected.standard_errors[1], 1e-12);
  EXPECT_NEAR(fit.coefficients[2], expected.coefficients[2], 1e-12);
  EXPECT_NEAR(fit.standard_errors[2], expected.standard_errors[2], 1e-12);
}

TEST(Regression, ConstantResponse) {
  const Regression fit = regress({{0.0, 1.0, 2.0}}, {0.1, 0.1, 0.1});
  EXPECT_NEAR(fit.coefficients[0], 0.1, 1e-15);
  EXPECT_NEAR(fit.coefficients[1], 0.0, 1e-15);
  EXPECT_TRUE(std::isnan(fit.r2));
}

TEST(Regression, Errors) {
  const std::vector<double> x{0.0, 1.0, 2.0, 3.0}, y{1.0, 3.0, 2.0, 5.0};
  EXPECT_EQ(regression_error({x, {1.0, 2.0, 3.0}}, y), "predictor 2 has 3 rows, the response 4");
  EXPECT_EQ(regression_error({{0.0, 1.0}}, {0.0, 1.0}), "2 rows are too few for 2 coefficients");
  EXPECT_EQ(regression_error({x, {1.0, 3.0, 5.0, 7.0}}, y),
            "only 2 of the 3 columns (constant and predictors) are linearly independent");
  EXPECT_EQ(regression_error({{0.3, 0.3, 0.3, 0.3}}, y),
            "only 1 of the 2 columns (constant and predictors) are linearly independent");
  EXPECT_EQ(regression_error({{0.0, 0.0, 0.0, 0.0}}, y),
            "only 1 of the 2 columns (constant and predictors) are linearly independent");
}
