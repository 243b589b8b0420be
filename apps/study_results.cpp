#include "apps/study_results.hpp"

#include "apps/study_plan.hpp"
#include "apps/usage.hpp"
#include "core/analysis/measures.hpp"
#include "io/atomic_file.hpp"
#include "io/series.hpp"
#include "io/text.hpp"
#include "render/body.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>
#include <stdexcept>

namespace scarp::apps {

namespace fs = std::filesystem;

namespace {

/// The history of a run, with that of the beginning it continues in front.
class WholeHistory {
 public:
  explicit WholeHistory(const fs::path& folder) : own_(io::read_table(folder / "history.csv")) {}

  void put_in_front(const fs::path& folder) { before_ = io::read_table(folder / "history.csv"); }

  std::vector<double> column(const std::string& name) const {
    std::vector<double> values;
    if (!before_.names.empty()) {
      // The last row of the beginning is the first one of what continues it.
      const std::vector<double>& time = before_.column("time_s");
      const double start = own_.column("time_s").front();
      for (std::size_t row = 0; row < time.size() && time[row] < start; ++row)
        values.push_back(before_.column(name)[row]);
    }
    const std::vector<double>& own = own_.column(name);
    values.insert(values.end(), own.begin(), own.end());
    return values;
  }

  /// The last value of an energy that each of the two counts from its own start.
  double total(const std::string& name) const {
    const double before = before_.names.empty() ? 0.0 : before_.column(name).back();
    return before + own_.column(name).back();
  }

 private:
  io::Table own_;
  io::Table before_;
};

/// At the end of the names of history.csv's energies.
std::string energy_unit(const Scene& scene) {
  return scene.grid.dimension == 2 ? "_J_per_m" : "_J";
}

/// In the order of result_columns.
std::vector<double> outputs_of(const PlannedRun& run, const nlohmann::ordered_json& record,
                               const fs::path& folder, const WholeHistory& history,
                               analysis::MeasureOptions options) {
  const std::string joule = energy_unit(run.scene);
  if (run.scene.grid.dimension == 3) options.thickness = 1.0;
  const analysis::SlideMeasures measures = analysis::measure(
      slide_record(run.scene, [&](const std::string& name) { return history.column(name); }),
      options);

  const io::SeriesReader series(folder);
  const std::size_t thrown = render::thrown_off(series.read(series.size() - 1)).size();
  const double nan = std::nan("");
  std::vector<double> values = {record.at("points").get<double>(),
                                record.at("steps").get<double>()};
  for (const analysis::MonitorMeasures& monitor : measures.monitors)
    values.insert(values.end(),
                  {monitor.velocity.value, monitor.velocity.time, monitor.acceleration.value});
  values.insert(values.end(),
                {measures.run_out, 1e-3 * measures.kinetic_energy.value,
                 measures.kinetic_energy.time, measures.rest.value_or(nan),
                 measures.after_rest_fraction.value_or(nan), static_cast<double>(thrown),
                 history.total("scheme_loss" + joule) / history.total("gravity_work" + joule),
                 record.at("wall_s").get<double>()});
  return values;
}

} // namespace

analysis::SlideRecord
slide_record(const Scene& scene,
             const std::function<std::vector<double>(const std::string&)>& column) {
  analysis::SlideRecord slide{.time = column("time_s"),
                              .monitor_velocity = {},
                              .kinetic_energy = column("kinetic" + energy_unit(scene)),
                              .rest_energy = column("grid_kinetic" + energy_unit(scene)),
                              .front = column("front_x_m")};
  for (const Monitor& monitor : scene.monitors)
    slide.monitor_velocity.push_back(column(monitor.name + "_vx_m_s"));
  return slide;
}

std::vector<std::string> result_columns(const io::Study& study, const Scene& scene) {
  std::vector<std::string> names = study.parameters;
  names.insert(names.end(), {"points", "steps"});
  for (const Monitor& monitor : scene.monitors)
    for (const char* format :
         {"peak_velocity_{}_m_s", "time_of_peak_velocity_{}_s", "peak_acceleration_{}_m_s2"})
      names.push_back(fmt::format(fmt::runtime(format), monitor.name));
  names.insert(names.end(), {"runout_m", "peak_kinetic_energy_kJ", "time_of_peak_kinetic_energy_s",
                             "rest_time_s", "after_rest_fraction", "thrown_points",
                             "scheme_loss_fraction", "wall_s"});
  std::set<std::string> different;
  for (const std::string& name : names)
    if (!different.insert(name).second)
      throw UsageError(fmt::format("a parameter is named '{}' as a result is", name));
  return names;
}

StudyResults collect_results(const io::Study& study, const fs::path& directory) {
  const StudyPlan plan = plan_study(study);
  StudyResults results;
  results.table.names = result_columns(study, plan.runs.front().scene);
  results.table.columns.resize(results.table.names.size());
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const PlannedRun& run = plan.runs[i];
    const fs::path folder = directory / run.name;
    const auto record = finished_record(folder);
    if (!record || !is_record_of(*record, run)) {
      results.missing.push_back(run.name);
      continue;
    }
    try {
      WholeHistory history(folder);
      if (continues_beginning(*record, run))
        history.put_in_front(beginning_folder(directory, run.beginning));
      std::vector<double> row = study.scenarios[i].inputs;
      const std::vector<double> outputs = outputs_of(run, *record, folder, history, study.measure);
      row.insert(row.end(), outputs.begin(), outputs.end());
      for (std::size_t column = 0; column < row.size(); ++column)
        results.table.columns[column].push_back(row[column]);
      results.scenarios.push_back(run.name);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("scenario {}: {}", run.name, error.what()));
    }
  }
  return results;
}

void write_results(const fs::path& file, const StudyResults& results) {
  std::string text = fmt::format("scenario,{}\n", fmt::join(results.table.names, ","));
  for (std::size_t row = 0; row < results.scenarios.size(); ++row) {
    text += results.scenarios[row];
    for (const std::vector<double>& column : results.table.columns)
      text += "," + io::number_text(column[row]);
    text += "\n";
  }
  io::write_atomically(file, text);
}

} // namespace scarp::apps
