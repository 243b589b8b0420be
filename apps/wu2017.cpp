#include "apps/wu2017.hpp"

#include "apps/data_directory.hpp"
#include "apps/run_scene.hpp"
#include "apps/study_results.hpp"
#include "apps/study_runner.hpp"
#include "apps/usage.hpp"
#include "apps/wu2017_case.hpp"
#include "apps/wu2017_figures.hpp"
#include "apps/wu2017_page.hpp"
#include "io/json_record.hpp"
#include "io/scene_file.hpp"
#include "io/study_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace scarp::apps {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// The rows of the paper's table that were computed, in the same order.
io::Table same_scenarios(const io::Table& paper, const io::Table& computed,
                         const std::vector<std::string>& scenarios) {
  io::Table rows{paper.names, std::vector<std::vector<double>>(paper.names.size())};
  for (std::size_t row = 0; row < scenarios.size(); ++row) {
    const auto number = std::ranges::find(paper.column("scenario"), std::stod(scenarios[row]));
    const auto from = static_cast<std::size_t>(number - paper.column("scenario").begin());
    for (std::size_t column = 0; column < paper.names.size(); ++column)
      rows.columns[column].push_back(paper.columns[column].at(from));
    for (const std::string& input : predictors())
      if (computed.column(input)[row] != rows.column(input)[row])
        throw std::runtime_error("scenario " + scenarios[row] + " is not that of table 1");
  }
  return rows;
}

Json regression_json(const Regressions& regressions) {
  Json record;
  for (const Quantity& quantity : quantities()) {
    const analysis::Regression& r = regressions.at(quantity.key);
    // peak_velocity, not peak_velocity_m_s: the coefficients have units of their own
    const std::string name = quantity.key.substr(0, quantity.key.rfind('_'));
    record[name.ends_with("_m") ? name.substr(0, name.size() - 2) : name] = {
        {"b0", r.coefficients[0]},
        {"c", r.coefficients[1]},
        {"phi", r.coefficients[2]},
        {"p", r.coefficients[3]},
        {"r2", r.r2},
        {"standard_errors", r.standard_errors}};
  }
  return record;
}

Json base_json(const BaseCase& base) {
  Json record;
  record["peak_kinetic_energy_kJ"] = 1e-3 * base.measures.kinetic_energy.value;
  record["time_of_peak_kinetic_energy_s"] = base.measures.kinetic_energy.time;
  record["runout_m"] = base.measures.run_out;
  record["rest_time_s"] = base.measures.rest ? Json(*base.measures.rest) : Json();
  record["thrown_points"] = base.thrown;
  for (std::size_t m = 0; m < base.scene.monitors.size(); ++m) {
    const analysis::MonitorMeasures& monitor = base.measures.monitors[m];
    const std::string& name = base.scene.monitors[m].name;
    record["peak_velocity_" + name + "_m_s"] = monitor.velocity.value;
    record["time_of_peak_velocity_" + name + "_s"] = monitor.velocity.time;
    record["peak_acceleration_" + name + "_m_s2"] = monitor.acceleration.value;
  }
  if (base.stages)
    record["stages_s"] = {{"compression", base.stages->compression},
                          {"creep", base.stages->creep},
                          {"acceleration", base.stages->acceleration},
                          {"deceleration", base.stages->deceleration},
                          {"rest", base.stages->rest}};
  for (const FittedCurve& curve : base.fits) {
    Json fit = {{"monitor", curve.monitor}, {"curve", curve.what}};
    if (curve.fit) {
      for (std::size_t i = 0; i < curve.fit->names.size(); ++i)
        fit[curve.fit->names[i]] = curve.fit->values[i];
      fit["r2"] = curve.fit->r2;
    }
    record["fits"].push_back(fit);
  }
  return record;
}

Json summary(const Wu2017& results) {
  Json record;
  const io::Table& computed = results.computed;
  record["points"] = computed.rows() > 0 ? computed.column("points").front() : std::nan("");
  record["wall_s"] = results.wall;
  record["failed_scenarios"] = results.failed.size();
  record["base"] = base_json(results.base);
  record["scenarios"] = Json::array();
  for (std::size_t row = 0; row < results.scenarios.size(); ++row) {
    Json scenario = {{"scenario", std::stoi(results.scenarios[row])}};
    for (const std::string& input : predictors()) scenario[input] = computed.column(input)[row];
    for (const Quantity& quantity : quantities()) {
      scenario["paper"][quantity.key] = results.paper.column(quantity.paper)[row];
      scenario["scarp"][quantity.key] = computed.column(quantity.column)[row];
    }
    for (const char* extra : {"rest_time_s", "thrown_points", "after_rest_fraction"})
      scenario["scarp"][extra] = computed.column(extra)[row];
    record["scenarios"].push_back(scenario);
  }
  for (const Quantity& quantity : quantities()) {
    const Agreement agreed =
        agreement(results.paper.column(quantity.paper), computed.column(quantity.column));
    record["agreement"][quantity.key] = {{"r2_correlation", agreed.correlation},
                                         {"r2_equality", agreed.equality},
                                         {"mean_absolute_difference", agreed.mean_error},
                                         {"largest_difference", agreed.largest_error}};
  }
  if (results.of_computed) record["regressions"] = regression_json(*results.of_computed);
  record["regressions_of_paper"] = regression_json(results.of_paper);
  return record;
}

} // namespace

void reproduce_wu2017(const Wu2017Options& options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const fs::path data = data_directory();
  io::Study study = io::read_study(data / "studies/wu2017.toml");
  for (io::Scenario& scenario : study.scenarios)
    scenario.overrides.insert(scenario.overrides.end(), options.set.begin(), options.set.end());
  const Scene scene = io::read_scene(study.scene, options.set);
  make_directory(options.out);

  run_scene(scene, options.out / "base", "wu2017", options.jobs);
  const StudyOutcome outcome = run_study(
      study, {.out = options.out / "scenarios", .jobs = options.jobs, .threads = 1, .shard = {}});
  if (outcome.signal != 0)
    throw std::runtime_error(fmt::format("stopped by signal {}", outcome.signal));

  Wu2017 results;
  results.folder = options.out / "scenarios";
  const StudyResults finished = collect_results(study, results.folder);
  write_results(options.out / "results.csv", finished);
  results.scenarios = finished.scenarios;
  results.failed = outcome.failed;
  results.computed = finished.table;
  const io::Table table1 = io::read_table(data / "reference/wu2017_table1.csv");
  results.paper = same_scenarios(table1, results.computed, results.scenarios);
  results.base = read_base_case(options.out / "base", scene, study.measure);
  results.of_paper = regressions(table1, &Quantity::paper);
  if (results.scenarios.size() > predictors().size() + 1)
    results.of_computed = regressions(results.computed, &Quantity::column);

  const std::vector<Figure> figures = draw_wu2017(results, options.out);
  results.wall = std::chrono::duration<double>(Clock::now() - start).count();
  io::write_json(options.out / "summary.json", summary(results));
  const Wu2017Report report(results, study.measure);
  report.print();
  report.write_page(options.out / "index.html", figures);
  fmt::print("\nopen {}; figures, results.csv and summary.json beside it\n",
             (options.out / "index.html").string());
  if (!results.failed.empty())
    throw std::runtime_error(
        fmt::format("{} of {} scenarios failed", results.failed.size(), outcome.scenarios));
}

} // namespace scarp::apps
