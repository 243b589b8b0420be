// scarp safety SCENE.toml --out DIR
#include "apps/commands.hpp"
#include "apps/safety.hpp"
#include "apps/safety_search.hpp"

#include "apps/usage.hpp"
#include "core/version.hpp"
#include "io/json_record.hpp"
#include "io/scene_file.hpp"
#include "render/frame_figure.hpp"
#include "render/line_chart.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include <unistd.h>

namespace scarp::apps {

namespace {

struct SafetyArguments {
  std::filesystem::path scene;
  std::filesystem::path out;
  std::vector<std::string> set;
  int threads = 0;
  SearchOptions search;
  FailureRule rule;
};

const char* word(Verdict verdict) {
  switch (verdict) {
  case Verdict::stable:
    return "stable";
  case Verdict::failed:
    return "failed";
  case Verdict::still_moving:
    break;
  }
  return "still moving";
}

void check(const SafetyArguments& options) {
  const auto above = [](const char* name, double value, double bound) {
    if (!(value > bound))
      throw UsageError(fmt::format("{}: is {}; must be above {}", name, value, bound));
  };
  above("--tolerance", options.search.tolerance, 0.0);
  above("--lower", options.search.lower, 0.0);
  above("--upper", options.search.upper, options.search.lower);
  above("--failure", options.rule.part_of_height, 0.0);
  above("--periods", options.rule.periods, StrengthReduction::rest_window);
}

/// How far a trial is, on a terminal only; empty once it is over.
class TrialLine {
 public:
  void show(double factor, double periods, double displacement, double limit) const {
    if (visible_)
      fmt::print(stderr, "\rF = {:.4f}: {:.0f} periods, moved {:.3g} of {:.3g} m   ", factor,
                 periods, displacement, limit);
  }
  void clear() const {
    if (visible_) fmt::print(stderr, "\r{:70}\r", "");
  }

 private:
  bool visible_ = ::isatty(STDERR_FILENO) != 0;
};

nlohmann::ordered_json record_of(const Trial& trial, const Scene& scene) {
  nlohmann::ordered_json record = {
      {"factor", trial.factor},
      {"verdict", word(trial.verdict)},
      {"displacement_m", trial.displacement},
      {scene.grid.dimension == 2 ? "kinetic_energy_J_per_m" : "kinetic_energy_J",
       trial.kinetic_energy},
      {"time_s", trial.time},
      {"steps", trial.steps},
      {"wall_s", trial.wall}};
  for (std::size_t m = 0; m < scene.monitors.size(); ++m)
    record["monitor_displacement_m"][scene.monitors[m].name] = trial.monitor_displacement[m];
  return record;
}

/// Displacements, as a part of the one that means failure, over the factor.
void draw_displacements(const std::filesystem::path& file, const std::vector<Trial>& trials,
                        const Scene& scene, double limit) {
  std::vector<render::Curve> curves(1 + scene.monitors.size());
  curves[0].label = "largest";
  for (std::size_t m = 0; m < scene.monitors.size(); ++m)
    curves[m + 1].label = scene.monitors[m].name;
  for (const Trial& trial : trials)
    for (std::size_t c = 0; c < curves.size(); ++c) {
      curves[c].x.push_back(trial.factor);
      curves[c].y.push_back(c == 0 ? trial.displacement : trial.monitor_displacement[c - 1]);
    }
  for (render::Curve& curve : curves) curve.marker = render::Marker::circle;
  curves.push_back({.label = "failed above",
                    .x = {trials.front().factor, trials.back().factor},
                    .y = {limit, limit},
                    .colour = render::palette::grey,
                    .line = render::LineKind::dashed});
  render::ChartStyle style;
  style.x_name = "factor that divides the strength";
  style.y_name = "displacement";
  style.y_unit = "m";
  render::write_png(file, render::render_chart(curves, style));
}

void draw_failure(const std::filesystem::path& file, const Trial& trial) {
  render::FrameStyle style;
  style.title = fmt::format("F = {:.3f}", trial.factor);
  style.height = 0;
  render::write_png(file, render::render_frame(trial.frame, style));
}

nlohmann::ordered_json record_of(const SafetyArguments& options, const StrengthReduction& body,
                                 const Bracket& bracket, const std::vector<Trial>& trials,
                                 const Scene& scene) {
  const auto or_null = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  nlohmann::ordered_json record;
  record["program"] = "scarp";
  record["version"] = version;
  record["factor"] = bracket.stable ? or_null(bracket.failed) : nullptr;
  record["bracket"] = {or_null(bracket.stable), or_null(bracket.failed)};
  record["monotone"] = bracket.monotone;
  record["tolerance"] = options.search.tolerance;
  record["lower"] = options.search.lower;
  record["upper"] = options.search.upper;
  record["height_m"] = body.height();
  record["period_s"] = body.period();
  record["settlement_m"] = body.settlement();
  record["failure"] = {{"displacement_m", body.failure_displacement()},
                       {"part_of_height", options.rule.part_of_height},
                       {"periods", options.rule.periods}};
  record["local_damping"] = body.local_damping();
  record["points"] = body.points();
  for (const Trial& trial : trials) record["trials"].push_back(record_of(trial, scene));
  record["scene"] = io::scene_to_json(scene);
  return record;
}

void find_safety(const SafetyArguments& options) {
  check(options);
  const Scene scene = io::read_scene(options.scene, options.set);
  if (options.threads > 0) omp_set_num_threads(options.threads);
  StrengthReduction body(scene, options.rule);
  make_directory(options.out);
  body.settle();
  fmt::print("{}\n  height {:.4g} m, period {:.3g} s, {} points, local damping {:.3g}\n"
             "  equilibrium: {}; settled by {:.3g} m\n"
             "  failed: a point moved by more than {:.3g} m; at rest: by less than {:.3g} m in {} "
             "periods\n\n{:>8}  {:<12} {:>14} {:>14} {:>10} {:>8}\n",
             scene.title, body.height(), body.period(), body.points(), body.local_damping(),
             body.own_equilibrium() ? "elastic, gravity rising" : "the stages before the last",
             body.settlement(), body.failure_displacement(),
             body.failure_displacement() * StrengthReduction::rest_window / options.rule.periods,
             StrengthReduction::rest_window, "F", "verdict", "displaced, m", "kinetic, J",
             "periods", "wall, s");

  std::vector<Trial> trials;
  const TrialLine line;
  const Bracket bracket = find_bracket(options.search, [&](double factor) {
    trials.push_back(body.try_factor(factor, [&](double periods, double displacement) {
      line.show(factor, periods, displacement, body.failure_displacement());
    }));
    const Trial& trial = trials.back();
    line.clear();
    fmt::print("{:8.4f}  {:<12} {:14.4g} {:14.4g} {:10.0f} {:8.1f}\n", factor, word(trial.verdict),
               trial.displacement, trial.kinetic_energy, trial.time / body.period(), trial.wall);
    std::fflush(stdout);
    return trial.fails();
  });

  std::ranges::sort(trials, {}, &Trial::factor);
  io::write_json(options.out / "safety.json", record_of(options, body, bracket, trials, scene));
  draw_displacements(options.out / "displacement.png", trials, scene, body.failure_displacement());
  const auto failed = std::ranges::find_if(trials, &Trial::fails);
  if (failed != trials.end()) draw_failure(options.out / "plastic_strain.png", *failed);

  if (!bracket.monotone)
    fmt::print("\nnot monotone: a factor stands above one that fails; the factor is uncertain\n");
  if (!bracket.stable)
    throw std::runtime_error(fmt::format("the body fails already at F = {}; try a smaller --lower",
                                         options.search.lower));
  if (!bracket.failed)
    throw std::runtime_error(
        fmt::format("the body stands at F = {}; try a larger --upper", options.search.upper));
  fmt::print(
      "\nfactor of safety {:.3f}: stands at {:.4f}, fails at {:.4f}; safety.json and figures "
      "in {}\n",
      *bracket.failed, *bracket.stable, *bracket.failed, options.out.string());
}

} // namespace

void add_safety(CLI::App& program) {
  const auto options = std::make_shared<SafetyArguments>();
  CLI::App* command =
      program.add_subcommand("safety", "Find a scene's factor of safety by strength reduction.");
  command->add_option("scene", options->scene, "Scene file (TOML); `scarp options` lists its keys")
      ->required();
  command->add_option("--out", options->out, "Directory for the results")->required();
  command->add_option("--set", options->set, "key=value that overrides the scene; repeatable")
      ->allow_extra_args(false);
  command->add_option("--threads", options->threads, "Threads; default: all there are")
      ->check(CLI::Range(1, 1024));
  command->add_option("--tolerance", options->search.tolerance, "Width of the bracket")
      ->capture_default_str();
  command->add_option("--lower", options->search.lower, "Smallest factor tried")
      ->capture_default_str();
  command->add_option("--upper", options->search.upper, "Largest factor tried")
      ->capture_default_str();
  command
      ->add_option("--failure", options->rule.part_of_height,
                   "Displacement that means failure, as a part of the height")
      ->capture_default_str();
  command
      ->add_option("--periods", options->rule.periods,
                   "A body at rest takes longer than these periods 4 H / c_s to move that far")
      ->capture_default_str();
  command->footer(fmt::format(
      "The smallest F at which the body fails with c/F and tan(phi)/F.  Every trial starts from\n"
      "the same equilibrium: the end of the stages before the scene's last one; a scene without\n"
      "such gets a stage with elastic materials and rising gravity.  The last stage is the one\n"
      "with reduced strength.  Runs are damped: local damping is {} if the scene has none.\n"
      "Failed: a point has moved, since the equilibrium, by more than a part of the height\n"
      "(--failure) plus the largest displacement on the way there.  At rest: in the last {}\n"
      "periods no point has moved at a pace that would get it there within --periods.\n"
      "Writes DIR/safety.json, DIR/displacement.png, and DIR/plastic_strain.png: the smallest F\n"
      "that fails.\n"
      "Example:\n  scarp safety data/scenes/griffiths_lane_1999.toml --out out/safety "
      "--set grid.cell_size_m=1",
      StrengthReduction::usual_damping, StrengthReduction::rest_window));
  command->callback([options] { find_safety(*options); });
}

} // namespace scarp::apps
