// The slope of Wu et al. 2017 as computed: the base case, the 29 scenarios, and what they say.
#pragma once

#include "core/analysis/curve_fit.hpp"
#include "core/analysis/measures.hpp"
#include "core/analysis/regression.hpp"
#include "core/analysis/slide_stages.hpp"
#include "core/scene.hpp"
#include "io/table.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scarp::apps {

/// One of the four quantities of the paper's table 1.
struct Quantity {
  std::string key;    ///< in summary.json
  std::string name;   ///< as figures call it
  std::string symbol; ///< in equations
  std::string unit;
  std::string paper;  ///< column of the paper's table
  std::string column; ///< of results.csv
  int digits;         ///< after the point, in tables
};
const std::array<Quantity, 4>& quantities();

/// Of the paper's table and of the regressions; the predictors of eqs. 24-27.
const std::array<std::string, 3>& predictors();

/// v = f(t) of a monitor over a part of the base case (eqs. 20-23).
struct FittedCurve {
  std::string monitor;
  std::string what;                      ///< such as "rising branch, exponential"
  double from, to;                       ///< s
  std::optional<analysis::CurveFit> fit; ///< none: it did not converge
};

struct BaseCase {
  std::filesystem::path folder;
  Scene scene;
  io::Table history;
  analysis::SlideMeasures measures;
  std::vector<analysis::Smoothed> velocity; ///< by monitor, m/s
  std::optional<analysis::SlideStages> stages;
  std::vector<FittedCurve> fits;
  std::size_t thrown = 0;
};

/// Reads a finished run of the base case.
BaseCase read_base_case(const std::filesystem::path& folder, const Scene& scene,
                        const analysis::MeasureOptions& options);

/// Coefficients of determination of computed values over the paper's.
struct Agreement {
  double correlation; ///< squared correlation: R2 of a straight line through the points
  double equality;    ///< R2 about the line of equality
  double mean_error;  ///< mean absolute difference
  double largest_error;
};
Agreement agreement(const std::vector<double>& paper, const std::vector<double>& computed);

/// y = b0 + bc c + bphi phi + bp p, by the name of the quantity.
using Regressions = std::map<std::string, analysis::Regression>;
Regressions regressions(const io::Table& table, std::string Quantity::*column);

/// "v_C = 10.69 - 0.0953 c - 0.347 phi + 0.00653 p"
std::string equation(const Quantity& quantity, const analysis::Regression& regression);

/// The whole of it.
struct Wu2017 {
  BaseCase base;
  io::Table paper;    ///< table 1, those scenarios that were computed
  io::Table computed; ///< results.csv, the same scenarios
  std::vector<std::string> scenarios;
  std::vector<std::string> failed;
  std::filesystem::path folder;           ///< of the study
  Regressions of_paper;                   ///< of the whole table 1
  std::optional<Regressions> of_computed; ///< none: too few scenarios
  double wall = 0.0;                      ///< s, of everything
};

} // namespace scarp::apps
