#include "io/run_recorder.hpp"

#include "core/fields.hpp"
#include "core/version.hpp"
#include "io/json_record.hpp"
#include "io/scene_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <sys/resource.h>

namespace scarp::io {

namespace {

std::vector<std::string> written_fields(const Scene& scene) {
  if (!scene.output.fields.empty()) return scene.output.fields;
  std::vector<std::string> names;
  for (const FieldInfo& info : field_table()) names.push_back(info.name);
  return names;
}

} // namespace

Frame frame_of(const Simulation& simulation, const Scene& scene) {
  Frame frame;
  frame.time = simulation.time();
  frame.step = simulation.steps();
  frame.dimension = simulation.dimension();
  frame.cell_size = scene.grid.cell_size;
  frame.lower = scene.grid.lower;
  frame.upper = scene.grid.upper;
  frame.position = simulation.positions();
  for (const std::string& name : written_fields(scene))
    frame.columns.push_back({name, field_info(name).components, simulation.field(name)});
  return frame;
}

namespace {

/// Energies are per metre of depth in plane strain.
std::string energy_unit(const Scene& scene) {
  return scene.grid.dimension == 2 ? "_J_per_m" : "_J";
}

std::vector<std::string> history_columns(const Scene& scene) {
  const std::string joule = energy_unit(scene);
  std::vector<std::string> names = {"time_s", "step"};
  for (const char* energy : {"kinetic", "grid_kinetic", "strain", "gravitational", "gravity_work",
                             "plastic_dissipation", "damping", "wall_friction", "scheme_loss"})
    names.push_back(energy + joule);
  names.emplace_back("front_x_m");
  for (const Monitor& monitor : scene.monitors)
    for (const char* what : {"_x_m", "_z_m", "_vx_m_s", "_vz_m_s"})
      names.push_back(monitor.name + what);
  return names;
}

long peak_memory_kib() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

} // namespace

RunRecorder::RunRecorder(const Scene& scene, const Simulation& simulation,
                         std::filesystem::path directory, const std::string& name, int threads)
    : scene_(scene), directory_(std::move(directory)), threads_(threads), series_(directory_, name),
      frames_([this](const Frame& frame) { series_.write(frame); }) {
  history_.emplace(directory_ / "history.csv", history_columns(scene));
  for (const Monitor& monitor : scene.monitors)
    monitored_.push_back(simulation.nearest_point(monitor.position));
}

void RunRecorder::frame(const Simulation& simulation) {
  frames_.wait_for_room();
  frames_.push(frame_of(simulation, scene_));
}

void RunRecorder::history(const Simulation& simulation, const Energies& energies) {
  frames_.check();
  std::vector<double> row = {simulation.time(),     static_cast<double>(simulation.steps()),
                             energies.kinetic,      energies.grid_kinetic,
                             energies.strain,       energies.gravitational,
                             energies.gravity_work, energies.plastic,
                             energies.damping,      energies.wall_friction,
                             energies.scheme_loss,  simulation.front()};
  if (!monitored_.empty()) {
    const std::vector<double> x = simulation.positions();
    const std::vector<double> v = simulation.field("velocity");
    for (const std::size_t point : monitored_)
      row.insert(row.end(), {x[3 * point], x[3 * point + 2], v[3 * point], v[3 * point + 2]});
  }
  history_->row(row);
}

void RunRecorder::progress(const Simulation&) { frames_.check(); }

std::vector<PlanLine> RunRecorder::plan() const {
  const Timing& timing = scene_.timing;
  const std::vector<std::string> fields = written_fields(scene_);
  const std::size_t skipped = field_table().size() - fields.size();
  std::vector<std::string> monitors;
  for (const Monitor& monitor : scene_.monitors) monitors.push_back(monitor.name);
  const bool until_rest = stages_of(scene_).back().until_rest;
  const std::string end = fmt::format("{:.6g} s", end_time(scene_));
  return {
      {"frames", fmt::format("every {:.4g} s, to which steps are cut; written by another thread, "
                             "from at most {} copies",
                             timing.output_interval, FrameQueue::most_waiting + 1)},
      {"fields", skipped == 0
                     ? fmt::format("all {}", fields.size())
                     : fmt::format("{}; the other {} skipped", fmt::join(fields, ", "), skipped)},
      {"history", fmt::format("energies and front every {:.4g} s, at the first step from then on; "
                              "skipped in between",
                              history_interval(timing))},
      {"monitors",
       monitors.empty() ? "none, skipped" : fmt::format("{}", fmt::join(monitors, ", "))},
      {"end", until_rest ? fmt::format(
                               "at rest (grid's kinetic energy below {:.4g} of its peak for {:.4g} "
                               "s), else at {}",
                               timing.rest_energy_fraction, timing.rest_duration, end)
                         : fmt::format("at {}; rest is not looked for", end)},
  };
}

void RunRecorder::finish(const Simulation& simulation, const std::optional<RunSummary>& summary,
                         const std::string& failure) {
  frames_.finish();
  const double wall = wall_seconds();
  const double work =
      static_cast<double>(simulation.points()) * static_cast<double>(simulation.steps());
  const Energies energies = simulation.energies();
  nlohmann::ordered_json record;
  record["program"] = "scarp";
  record["version"] = version;
  record["ended"] = !failure.empty()                         ? "failed"
                    : summary->reason == StopReason::at_rest ? "at rest"
                                                             : "end time";
  if (!failure.empty()) record["failure"] = failure;
  record["points"] = simulation.points();
  record["cells"] = simulation.cells();
  record["steps"] = simulation.steps();
  record["stop_time_s"] = simulation.time();
  if (summary) {
    record["shortest_step_s"] = summary->shortest_step;
    record["longest_step_s"] = summary->longest_step;
    record["peak_kinetic_energy" + energy_unit(scene_)] = summary->peak_kinetic;
  }
  record["wall_s"] = wall;
  record["threads"] = threads_;
  record["point_steps_per_s"] = wall > 0.0 ? work / wall : 0.0;
  record["peak_memory_MiB"] = static_cast<double>(peak_memory_kib()) / 1024.0;
  record["frames"] = series_.frames();
  record["energies" + energy_unit(scene_)] = {{"gravity_work", energies.gravity_work},
                                              {"kinetic", energies.kinetic},
                                              {"strain", energies.strain},
                                              {"plastic_dissipation", energies.plastic},
                                              {"damping", energies.damping},
                                              {"wall_friction", energies.wall_friction},
                                              {"scheme_loss", energies.scheme_loss}};
  for (const PlanLine& line : simulation.plan()) record["plan"][line.what] = line.how;
  for (const PlanLine& line : plan()) record["plan"][line.what] = line.how;
  record["scene"] = scene_to_json(scene_);
  write_json(directory_ / "run.json", record);
}

double RunRecorder::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

} // namespace scarp::io
