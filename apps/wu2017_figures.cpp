#include "apps/wu2017_figures.hpp"

#include "core/lattice.hpp"
#include "io/series.hpp"
#include "render/chart_panels.hpp"
#include "render/field_panels.hpp"
#include "render/lattice_figure.hpp"
#include "render/line_chart.hpp"
#include "render/model_figure.hpp"
#include "render/multi_panel.hpp"
#include "render/parity_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace scarp::apps {

namespace fs = std::filesystem;

namespace {

/// s, of figure 10: the loading, creep, two of the acceleration, two of the deceleration; the last
/// panel is the end.
constexpr std::array<double, 5> moments = {3.0, 4.0, 5.0, 6.5, 8.0};

render::Polyline outline(const Region& region) {
  render::Polyline line;
  for (const auto& corner : region.polygon) line.push_back({corner[0], corner[1]});
  return line;
}

const Region& region(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.regions, name, &Region::name);
  if (found == scene.regions.end()) throw std::runtime_error("the scene has no region " + name);
  return *found;
}

io::Frame frame_at(const io::SeriesReader& series, double time) {
  for (std::size_t i = 0; i < series.size(); ++i)
    if (std::abs(series.time(i) - time) < 1e-6) return series.read(i);
  throw std::runtime_error(fmt::format("{}: there is no frame at {} s", series.name(), time));
}

/// What a material point stands for: the part of its lattice square inside its region.
std::vector<render::LatticePiece> pieces(const Scene& scene, const render::Box& view) {
  const double a = scene.grid.cell_size / scene.grid.points_per_cell;
  std::vector<render::LatticePiece> all;
  for (const Region& body : scene.regions)
    for (double z = std::floor(view.lower.y / a) * a; z < view.upper.y; z += a)
      for (double x = std::floor(view.lower.x / a) * a; x < view.upper.x; x += a) {
        const std::vector<Point2> part = clip(body.polygon, {x, z}, {x + a, z + a});
        const PolygonMeasure size = measure(part);
        if (std::abs(size.area) < 1e-6 * a * a) continue;
        render::LatticePiece piece;
        for (const Point2& corner : part) piece.outline.push_back({corner[0], corner[1]});
        piece.point = {size.centroid[0], size.centroid[1]};
        piece.cut = std::abs(size.area) < (1.0 - 1e-6) * a * a;
        all.push_back(piece);
      }
  return all;
}

/// Figure 6: a few cells around the middle of the face.
render::Image points_at_the_face(const Scene& scene) {
  const auto middle = scene.monitors.at(1).position;
  const double h = scene.grid.cell_size;
  const auto node = [&](double x) { return std::round(x / h) * h; };
  const render::Box view = {{node(middle[0]) - 4 * h, node(middle[2]) - 3 * h},
                            {node(middle[0]) + 4 * h, node(middle[2]) + 3 * h}};
  render::LatticeStyle style;
  style.cell_size = h;
  style.view = view;
  style.sides = {outline(region(scene, "slope"))};
  style.full_label = "full square";
  style.cut_label = "triangle at the face";
  return render::render_lattice(pieces(scene, view), style);
}

/// Figure 7.
render::Image model(const BaseCase& base, const io::Frame& first) {
  const Scene& scene = base.scene;
  render::ModelStyle style;
  style.left = {render::Support::roller, "symmetry"};
  style.right = {render::Support::roller, "symmetry"};
  style.bottom = {render::Support::fixed, "fixed"};
  for (const Monitor& monitor : scene.monitors)
    style.places.push_back({{monitor.position[0], monitor.position[2]}, monitor.name});
  style.parts = {{outline(region(scene, "surcharge")), "surcharge"},
                 {outline(region(scene, "slope")), "slope"},
                 {outline(region(scene, "foundation")), "foundation"}};
  const auto dimension = [](render::Point from, render::Point to, double away) {
    return render::DimensionMark{from, to, {}, away};
  };
  style.dimensions = {dimension({25, 40}, {45, 40}, 1.2),   dimension({25, 35}, {25, 40}, 1.2),
                      dimension({120, 35}, {120, 10}, 3.6), dimension({120, 10}, {120, 0}, 3.6),
                      dimension({45, 0}, {0, 0}, 3.2),      dimension({70, 0}, {45, 0}, 3.2),
                      dimension({120, 0}, {70, 0}, 3.2)};
  const auto soil = std::ranges::find_if(scene.materials, [](const Material& material) {
    return std::holds_alternative<DruckerPrager>(material.law);
  });
  style.notes = {fmt::format("{} points, cells of {:.3g} m", first.size(), scene.grid.cell_size)};
  if (soil != scene.materials.end()) {
    const auto& law = std::get<DruckerPrager>(soil->law);
    style.notes.push_back(fmt::format("density {:.0f} kg/m\u00b3, E = {:.3g} MPa, \u03bd = {:.2g}",
                                      soil->density, soil->youngs_modulus / 1e6,
                                      soil->poissons_ratio));
    style.notes.push_back(
        fmt::format("c = {:.3g} kPa, \u03c6 = {:.3g}\u00b0, \u03c8 = {:.3g}\u00b0",
                    law.cohesion / 1e3, law.friction_angle, law.dilation_angle));
  }
  return render::render_model(first, style);
}

/// Figure 8: multiples of gravity by the stages' ramps.
render::Image loading(const Scene& scene) {
  render::Curve slope{.label = "gravity of the slope", .x = {}, .y = {}};
  render::Curve block{.label = "gravity of the surcharge", .x = {}, .y = {}};
  double start = 0.0;
  for (const Stage& stage : scene.stages) {
    std::vector<double> times = {0.0, stage.duration};
    const auto own = stage.body_force.find("surcharge");
    const Ramp ramp = own == stage.body_force.end() ? Ramp{} : own->second;
    for (const Ramp* each : {&stage.gravity, &ramp})
      for (const auto& point : each->points)
        if (point[0] < stage.duration) times.push_back(point[0]);
    std::ranges::sort(times);
    for (const double t : times) {
      slope.x.push_back(start + t);
      slope.y.push_back(stage.gravity.at(t));
      block.x.push_back(start + t);
      block.y.push_back(stage.gravity.at(t) * ramp.at(t));
    }
    start += stage.duration;
  }
  block.line = render::LineKind::dashed;
  render::ChartStyle style;
  style.x_name = "time";
  style.x_unit = "s";
  style.y_name = "gravity";
  style.y_unit = "multiple of g";
  style.x_limits = {0.0, start};
  style.y_limits = {0.0, 1.1 * std::ranges::max(block.y)};
  style.height = 900;
  return render::render_chart({slope, block}, style);
}

/// Figure 9, tension positive.
render::Image initial_stress(const io::Frame& frame) {
  render::FrameStyle style;
  style.height = 0;
  style.width = 1600;
  style.columns = 1;
  return render::render_field_panels(frame,
                                     {{{"stress", 2, "kPa"}, "vertical stress"},
                                      {{"stress", 0, "kPa"}, "horizontal stress"},
                                      {{"stress", 5, "kPa"}, "shear stress"}},
                                     style);
}

/// Figure 10.
render::Image shapes(const io::SeriesReader& series) {
  std::vector<io::Frame> frames;
  frames.reserve(moments.size() + 1);
  for (const double time : moments) frames.push_back(frame_at(series, time));
  frames.push_back(series.read(series.size() - 1));
  render::FrameStyle style;
  style.range = render::ColourRange{
      .lower = 0.0, .upper = 2.0, .bands = 20, .values_below = false, .values_above = true};
  style.view = render::Box{{0.0, 0.0}, {120.0, 42.0}};
  style.columns = 2;
  style.height = 0;
  style.time_digits = 1;
  return render::render_panels(frames, style);
}

/// Figure 11: velocities as recorded (thin), smoothed, and the fits (dashed).
render::Image velocities(const BaseCase& base) {
  const std::array<render::Colour, 3> colours = {render::palette::blue, render::palette::vermilion,
                                                 render::palette::green};
  const std::vector<double>& time = base.history.column("time_s");
  std::vector<render::Curve> curves;
  for (std::size_t m = 0; m < base.scene.monitors.size(); ++m) {
    const std::string& name = base.scene.monitors[m].name;
    const render::Colour colour = colours[m % colours.size()];
    curves.push_back({.label = {},
                      .x = time,
                      .y = base.history.column(name + "_vx_m_s"),
                      .colour = colour,
                      .weight = 0.4});
    curves.push_back({.label = name, .x = time, .y = base.velocity[m].value, .colour = colour});
  }
  std::string label = "fits";
  for (const FittedCurve& fit : base.fits) {
    if (!fit.fit) continue;
    render::Curve curve{.label = std::exchange(label, {}),
                        .x = {},
                        .y = {},
                        .colour = render::ink,
                        .line = render::LineKind::dashed,
                        .weight = 0.8};
    for (double t = fit.from; t <= fit.to; t += 0.05) {
      curve.x.push_back(t);
      curve.y.push_back(fit.fit->evaluate(t));
    }
    curves.push_back(curve);
  }
  render::ChartStyle style;
  style.x_name = "time";
  style.x_unit = "s";
  style.y_name = "horizontal velocity";
  style.y_unit = "m/s";
  style.x_limits = {0.0, time.back()};
  if (base.stages)
    style.spans = {{"I", {base.stages->compression, base.stages->creep}},
                   {"II", {base.stages->creep, base.stages->acceleration}},
                   {"III", {base.stages->acceleration, base.stages->deceleration}},
                   {"IV", {base.stages->deceleration, base.stages->rest}}};
  return render::render_chart(curves, style);
}

/// Figure 12: one family a parameter, those scenarios in which the two others are the base's.
render::Image energies(const Wu2017& results) {
  const io::Table& inputs = results.computed;
  const std::array<const char*, 3> names = {"cohesion", "friction angle", "surcharge"};
  const std::array<const char*, 3> units = {"kPa", "\u00b0", "kPa"};
  const std::array<double, 3> base = {20.0, 25.0, 294.0};
  std::vector<render::Chart> charts;
  for (const std::size_t varied : {2U, 1U, 0U}) {
    render::Chart chart;
    for (std::size_t row = 0; row < results.scenarios.size(); ++row) {
      bool in_family = true;
      for (std::size_t other = 0; other < 3; ++other)
        in_family = in_family &&
                    (other == varied || inputs.column(predictors()[other])[row] == base[other]);
      if (!in_family) continue;
      const io::Table history =
          io::read_table(results.folder / results.scenarios[row] / "history.csv");
      std::vector<double> energy = history.column("kinetic_J_per_m");
      for (double& value : energy) value *= 1e-3 * 0.5;
      chart.curves.push_back({.x = history.column("time_s"),
                              .y = energy,
                              .weight = 0.8,
                              .parameter = inputs.column(predictors()[varied])[row]});
    }
    chart.style.parameter_name = names[varied];
    chart.style.parameter_unit = units[varied];
    chart.style.x_name = "time";
    chart.style.x_unit = "s";
    chart.style.x_limits = {3.0, 12.0};
    chart.style.y_name = "kinetic energy";
    chart.style.y_unit = "kJ per 0.5 m";
    if (!chart.curves.empty()) charts.push_back(chart);
  }
  render::ChartPanelsStyle style;
  style.columns = 3;
  style.width = 2700;
  style.font_size = 26;
  return render::render_chart_panels(charts, style);
}

render::Image parity(const Wu2017& results) {
  std::vector<render::Chart> charts;
  for (const Quantity& quantity : quantities()) {
    const std::vector<double>& paper = results.paper.column(quantity.paper);
    const std::vector<double>& computed = results.computed.column(quantity.column);
    const Agreement agreed = agreement(paper, computed);
    render::ParityStyle style;
    style.quantity = quantity.name;
    style.unit = quantity.unit;
    style.reference = "Wu et al. 2017";
    style.tolerance = 0.05;
    style.notes = {fmt::format("R\u00b2 = {:.3f}, about equality {:.3f}", agreed.correlation,
                               agreed.equality)};
    charts.push_back(render::parity_chart(paper, computed, style));
  }
  return render::render_chart_panels(charts, {.columns = 2});
}

render::Image residuals(const Wu2017& results) {
  std::vector<render::Chart> charts;
  for (const Quantity& quantity : quantities()) {
    const analysis::Regression& regression = results.of_computed->at(quantity.key);
    std::vector<double> fitted = results.computed.column(quantity.column);
    for (std::size_t i = 0; i < fitted.size(); ++i) fitted[i] -= regression.residuals[i];
    charts.push_back(
        render::residual_chart(fitted, regression.residuals,
                               {.quantity = quantity.name,
                                .unit = quantity.unit,
                                .notes = {fmt::format("R\u00b2 = {:.3f}", regression.r2)}}));
  }
  return render::render_chart_panels(charts, {.columns = 2});
}

} // namespace

std::vector<Figure> draw_wu2017(const Wu2017& results, const fs::path& directory) {
  std::vector<Figure> figures;
  const auto add = [&](const char* name, const render::Image& image, const std::string& caption) {
    render::write_png(directory / name, image);
    figures.push_back({directory / name, caption});
  };
  const BaseCase& base = results.base;
  const io::SeriesReader series(base.folder);
  add("figure6_points.png", points_at_the_face(base.scene),
      "Figure 6. Material points where the face cuts the lattice.");
  add("figure7_model.png", model(base, series.read(0)),
      "Figure 7. Model, supports and the monitors A, B, C.");
  add("figure8_loading.png", loading(base.scene),
      "Figure 8. Loading: gravity comes on linearly, elastic; then the surcharge's own gravity.");
  add("figure9_initial_stress.png",
      initial_stress(frame_at(series, base.scene.stages.front().duration)),
      "Figure 9. Initial stress, tension positive: a) vertical, b) horizontal, c) shear.");
  add("figure10_plastic_strain.png", shapes(series),
      "Figure 10. Shape and equivalent plastic strain at six moments.");
  add("figure11_velocities.png", velocities(base),
      "Figure 11. Horizontal velocity of the monitors as recorded (thin) and smoothed, the fits of "
      "eqs. 20-23 (dashed), and the stages of the slide.");
  add("figure12_kinetic_energy.png", energies(results),
      "Figure 12. Kinetic energy against time over a) surcharge, b) friction angle, c) cohesion.");
  add("parity.png", parity(results),
      "Paper against scarp, all scenarios: dots on the line agree, dashed lines are 5 % off.");
  if (results.of_computed)
    add("residuals.png", residuals(results),
        "Residuals of the regressions (eqs. 24-27) on scarp's own table.");
  return figures;
}

} // namespace scarp::apps
