#include "apps/bui2008.hpp"

#include "apps/data_directory.hpp"
#include "apps/run_scene.hpp"
#include "io/json_record.hpp"
#include "io/scene_file.hpp"
#include "io/series.hpp"
#include "io/table.hpp"
#include "render/body.hpp"
#include "render/line_chart.hpp"
#include "render/model_figure.hpp"
#include "render/multi_panel.hpp"
#include "render/validation_figure.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace scarp::apps {

namespace fs = std::filesystem;

namespace {

/// s after the release, the moments of figure 3; the last panel is the end.
constexpr std::array<double, 4> typical_times = {0.0, 0.1, 0.2, 0.3};

/// m; the experiment's failure line is where rods have moved by 1 mm.  How much less far the
/// model's have at the same place shows in its line of this.
constexpr double slight_motion = 0.3e-3;

struct Measures {
  render::CurveError surface;
  render::CurveError failure;
  render::CurveError slightly_moved; ///< the line of slight_motion against the experiment's
  double run_out = 0.0;              ///< m
  double volume_error = 0.0;         ///< -
  std::size_t thrown = 0;
};

Measures measure_pile(const io::Frame& last, const io::Table& surface, const io::Table& failure) {
  const render::BodyShape body = render::measure_body(last);
  return {render::surface_error(body, surface),
          render::failure_error(render::failure_line(last), failure),
          render::failure_error(render::failure_line(last, slight_motion), failure),
          body.run_out,
          render::max_abs_volume_ratio_error(last).value_or(0.0),
          render::thrown_off(last).size()};
}

/// Column of the history that holds an energy, and its last value.
double last_of(const io::Table& history, const std::string& name) {
  return history.column(name).back();
}

void draw_model(const fs::path& file, const io::Frame& first, const Scene& scene) {
  const Material& rods = scene.materials.front();
  render::ModelStyle style;
  style.left = {render::Support::roller, "symmetry"};
  style.bottom = {render::Support::fixed,
                  scene.grid.walls[2][0].kind == WallKind::fixed ? "fixed" : "friction"};
  style.notes = {
      fmt::format("{} points, cells of {:.4g} mm", first.size(), 1e3 * scene.grid.cell_size),
      fmt::format("density {:.0f} kg/m3", rods.density),
      fmt::format("Young's modulus {:.3g} MPa, Poisson's ratio {:.2g}", rods.youngs_modulus / 1e6,
                  rods.poissons_ratio)};
  if (const auto* law = std::get_if<DruckerPrager>(&rods.law)) {
    style.notes.push_back(fmt::format("friction angle {:.1f}\u00b0, cohesion {:.3g} Pa",
                                      law->friction_angle, law->cohesion));
    if (law->rate_strengthening > 0)
      style.notes.push_back(fmt::format(
          "shear over mean stress grows by {:.3g} I{}, rods of {:.3g} mm", law->rate_strengthening,
          std::isinf(law->rate_strengthening_limit)
              ? ""
              : fmt::format(", {:.3g} at most", law->rate_strengthening_limit),
          1e3 * law->grain_diameter));
  }
  render::write_png(file, render::render_model(first, style));
}

void draw_panels(const fs::path& file, const io::SeriesReader& series, double release) {
  std::vector<io::Frame> frames;
  for (const double time : typical_times)
    for (std::size_t i = 0; i < series.size(); ++i)
      if (std::abs(series.time(i) - release - time) < 1e-9) frames.push_back(series.read(i));
  frames.push_back(series.read(series.size() - 1));
  render::FrameStyle style;
  // Half a unit a band tells the bands of shear apart; the layer sliding on the base goes far
  // beyond.
  style.range = render::ColourRange{
      .lower = 0.0, .upper = 8.0, .bands = 16, .values_below = false, .values_above = true};
  style.view = render::common_view(frames);
  style.height = 0;
  render::write_png(file, render::render_panels(frames, style));
}

void draw_energies(const fs::path& file, const io::Table& history) {
  const auto curve = [&](const char* label, const char* column) {
    return render::Curve{
        .label = label, .x = history.column("time_s"), .y = history.column(column)};
  };
  render::ChartStyle style;
  style.x_name = "time";
  style.x_unit = "s";
  style.y_name = "energy";
  style.y_unit = "J per m";
  render::write_png(
      file, render::render_chart({curve("work of gravity", "gravity_work_J_per_m"),
                                  curve("plastic dissipation", "plastic_dissipation_J_per_m"),
                                  curve("kinetic", "kinetic_J_per_m"),
                                  curve("elastic strain", "strain_J_per_m"),
                                  curve("the scheme's own loss", "scheme_loss_J_per_m")},
                                 style));
}

} // namespace

const std::map<std::string, PileModel>& pile_models() {
  const std::string rate = "material.rods.rate_strengthening=1"; // core/evolving_strength.hpp
  // 0.36 = tan(19.8 degrees): it slides in the rods.
  const std::string base = R"(walls.z_lower={kind = "friction", coefficient = 0.36})";
  static const std::map<std::string, PileModel> models = {
      {"published", {"as in Wu 2017", {}}},
      {"disks",
       {"it grows up to a limit, as in columns of disks",
        {"material.rods.rate_strengthening=0.7", "material.rods.rate_strengthening_limit=0.28"}}},
      {"inertial", {"friction grows with the inertial number", {rate}}},
      {"inertial_sliding", {"the same, and the base bears the rods' own friction", {rate, base}}}};
  return models;
}

void reproduce_bui2008(const Bui2008Options& options) {
  const fs::path data = data_directory();
  const io::Table surface = io::read_table(data / "reference/bui2008_surface.csv");
  const io::Table failure = io::read_table(data / "reference/bui2008_failure.csv");
  std::vector<std::string> set = pile_models().at(options.model).set;
  set.push_back(fmt::format("grid.cell_size_m={}", options.cell_size));
  set.insert(set.end(), options.set.begin(), options.set.end());
  const Scene scene = io::read_scene(data / "scenes/bui2008.toml", set);

  const RunOutcome outcome = run_scene(scene, options.out, "bui2008", options.threads);

  const io::SeriesReader series(options.out / "bui2008.pvd");
  const io::Table history = io::read_table(options.out / "history.csv");
  const io::Frame last = series.read(series.size() - 1);
  const Measures measures = measure_pile(last, surface, failure);
  const double work = last_of(history, "gravity_work_J_per_m");
  const double loss = last_of(history, "scheme_loss_J_per_m");
  const double front = surface.column("x_m").back();

  using Clock = std::chrono::steady_clock;
  draw_model(options.out / "figure2_model.png", series.read(0), scene);
  draw_panels(options.out / "figure3_plastic_strain.png", series,
              scene.gates.empty() ? 0.0 : scene.gates.front().release_time);
  render::write_png(options.out / "figure5_validation.png",
                    render::render_validation(last, {.surface = surface, .failure = failure}));
  draw_energies(options.out / "energies.png", history);
  const Clock::time_point before = Clock::now();
  render::write_png(options.out / "frame_last.png", render::render_frame(last, {}));
  const double frame_seconds = std::chrono::duration<double>(Clock::now() - before).count();

  const auto row = [](const std::string& what, const std::string& value,
                      const std::string& experiment, const std::string& error) {
    fmt::print("{:<34} {:>12} {:>12} {:>24}\n", what, value, experiment, error);
  };
  const auto errors = [](const render::CurveError& error) {
    return fmt::format("RMS {:.2f}, max {:.2f} mm", 1e3 * error.rms, 1e3 * error.max);
  };
  fmt::print("\n");
  row("", "scarp", "experiment", "error");
  row("points", fmt::format("{}", outcome.points), "", "");
  row("free surface", "", "", errors(measures.surface));
  row("failure line", "", "", errors(measures.failure));
  row(fmt::format("  its line of {:.1f} mm, not 1 mm", 1e3 * slight_motion), "", "",
      errors(measures.slightly_moved));
  row("front of the body, m", fmt::format("{:.3f}", measures.run_out), fmt::format("{:.3f}", front),
      fmt::format("{:+.0f} mm", 1e3 * (measures.run_out - front)));
  row(outcome.at_rest ? "at rest after, s" : "stopped, not at rest, s",
      fmt::format("{:.3f}", outcome.stop_time), "", "");
  row("points thrown off", fmt::format("{}", measures.thrown), "0", "");
  row("largest |V/V0 - 1| of a point", fmt::format("{:.3g}", measures.volume_error), "", "");
  row("work of gravity, J per m", fmt::format("{:.3f}", work), "", "");
  row("the scheme's own loss of it", fmt::format("{:.2f} %", 100.0 * loss / work), "", "");
  row("steps", fmt::format("{}", outcome.steps), "", "");
  row("wall time of the run, s", fmt::format("{:.1f}", outcome.wall), "", "");
  row("wall time of a frame, s", fmt::format("{:.2f}", frame_seconds), "", "");

  nlohmann::ordered_json summary;
  summary["model"] = options.model;
  summary["points"] = outcome.points;
  summary["steps"] = outcome.steps;
  summary["wall_s"] = outcome.wall;
  summary["frame_wall_s"] = frame_seconds;
  summary["surface_rms_mm"] = 1e3 * measures.surface.rms;
  summary["surface_max_mm"] = 1e3 * measures.surface.max;
  summary["failure_rms_mm"] = 1e3 * measures.failure.rms;
  summary["failure_max_mm"] = 1e3 * measures.failure.max;
  summary["slightly_moved_mm"] = 1e3 * slight_motion;
  summary["slightly_moved_rms_mm"] = 1e3 * measures.slightly_moved.rms;
  summary["runout_m"] = measures.run_out;
  summary["experiment_runout_m"] = front;
  summary["stop_time_s"] = outcome.stop_time;
  summary["at_rest"] = outcome.at_rest;
  summary["max_abs_volume_ratio_error"] = measures.volume_error;
  summary["thrown_points"] = measures.thrown;
  summary["energies_J_per_m"] = {
      {"gravity_work", work},
      {"kinetic", last_of(history, "kinetic_J_per_m")},
      {"strain", last_of(history, "strain_J_per_m")},
      {"plastic_dissipation", last_of(history, "plastic_dissipation_J_per_m")},
      {"damping", last_of(history, "damping_J_per_m")},
      {"wall_friction", last_of(history, "wall_friction_J_per_m")},
      {"scheme_loss", loss}};
  summary["scheme_loss_part"] = loss / work;
  io::write_json(options.out / "summary.json", summary);
  fmt::print("\nfigures, series (bui2008.pvd) and summary.json in {}\n", options.out.string());
}

} // namespace scarp::apps
