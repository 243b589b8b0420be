#include "io/scene_checks.hpp"

#include "io/polygon.hpp"
#include "io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace scarp::io {
namespace {

constexpr double cell_tolerance = 1e-6; // of a cell
constexpr double most_cells = 1e9;
constexpr double most_points = 1e9;
constexpr double most_frames = 1e6;
constexpr const char* axis_names[] = {"x", "y", "z"};

std::vector<std::size_t> axes_of(const Grid& grid) {
  return grid.dimension == 3 ? std::vector<std::size_t>{0, 1, 2} : std::vector<std::size_t>{0, 2};
}

bool grid_usable(const SceneReport& report) {
  return report.usable({"grid.dimension", "grid.cell_size_m", "grid.lower_m", "grid.upper_m"});
}

bool on_grid_plane(const Grid& grid, std::size_t axis, double position) {
  const double cells = (position - grid.lower[axis]) / grid.cell_size;
  return std::abs(cells - std::round(cells)) <= cell_tolerance;
}

bool within(const Grid& grid, std::size_t axis, double position) {
  const double tolerance = cell_tolerance * grid.cell_size;
  return position >= grid.lower[axis] - tolerance && position <= grid.upper[axis] + tolerance;
}

std::string extent(const Grid& grid, std::size_t axis) {
  return fmt::format("{} runs from {} to {}", axis_names[axis], number_text(grid.lower[axis]),
                     number_text(grid.upper[axis]));
}

void check_grid(const Grid& grid, SceneReport& report) {
  if (!grid_usable(report)) return;
  double cells = 1.0;
  for (const std::size_t axis : axes_of(grid)) {
    const double count = (grid.upper[axis] - grid.lower[axis]) / grid.cell_size;
    if (count <= 0.0) {
      report.problem("grid.upper_m", fmt::format("is not above the lower corner: {}; must be above "
                                                 "grid.lower_m along every axis",
                                                 extent(grid, axis)));
      return;
    }
    cells *= std::max(1.0, count);
  }
  if (!(cells <= most_cells)) {
    report.problem("grid.cell_size_m",
                   fmt::format("makes {:.3g} cells; must make at most {:.0e}", cells, most_cells));
    return;
  }
  for (const std::size_t axis : axes_of(grid))
    if (!on_grid_plane(grid, axis, grid.upper[axis]))
      report.problem("grid.upper_m",
                     fmt::format("leaves {:.8g} cells of {} m: {}; must be a whole number of cells "
                                 "above grid.lower_m",
                                 (grid.upper[axis] - grid.lower[axis]) / grid.cell_size,
                                 number_text(grid.cell_size), extent(grid, axis)));
}

void check_time(const Scene& scene, SceneReport& report) {
  const Timing& timing = scene.timing;
  const double end = end_time(scene);
  if (!report.usable({"time", "stage"})) return;
  if (scene.stages.empty() && !report.placed("time.end_s")) {
    report.problem("time.end_s", "is missing; must be a number > 0, in s, where there is no "
                                 "[[stage]]");
  } else if (!scene.stages.empty() && report.placed("time.end_s")) {
    report.problem("time.end_s", "is given besides [[stage]]; must be left out, as the stages' "
                                 "durations say it");
  } else if (report.usable({"time.end_s", "time.output_interval_s"})) {
    if (timing.output_interval > end)
      report.problem("time.output_interval_s",
                     fmt::format("is {}; must be at most {}, {}",
                                 number_text(timing.output_interval),
                                 scene.stages.empty() ? "time.end_s" : "the stages' durations",
                                 number_text(end)));
    if (end / timing.output_interval > most_frames)
      report.problem("time.output_interval_s",
                     fmt::format("makes {:.3g} frames; must make at most {:.0e}",
                                 end / timing.output_interval, most_frames));
  }
  if (report.usable({"time.rest_energy_fraction", "time.rest_duration_s"}) &&
      timing.rest_energy_fraction > 0.0 && timing.rest_duration == 0.0)
    report.problem("time.rest_duration_s",
                   "is 0; must be > 0 where time.rest_energy_fraction is, as every scene starts at "
                   "rest");
}

template <typename Item> bool has_name(const std::vector<Item>& items, const std::string& name) {
  return std::ranges::find(items, name, &Item::name) != items.end();
}

template <typename Item>
std::string unknown_name(const std::string& name, const std::vector<Item>& items,
                         const std::string& what) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const Item& item : items) names.push_back(item.name);
  const std::string hint = did_you_mean(name, names);
  return fmt::format("names '{}'; must be the name of a [[{}]]: {}{}", name, what,
                     quoted_list(names, "or"), hint.empty() ? "" : " (" + hint + ")");
}

void check_stage_materials(const Scene& scene, const Stage& stage, const std::string& key,
                           SceneReport& report) {
  if (!report.usable({key + ".material", "region", "material"})) return;
  for (const auto& [name, material] : stage.material) {
    if (!has_name(scene.regions, name)) {
      report.problem(key + ".material", unknown_name(name, scene.regions, "region"));
    } else if (!has_name(scene.materials, material)) {
      report.problem(key + ".material", unknown_name(material, scene.materials, "material"));
    } else {
      const std::string& own = std::ranges::find(scene.regions, name, &Region::name)->material;
      const auto before = std::ranges::find(scene.materials, own, &Material::name);
      const auto after = std::ranges::find(scene.materials, material, &Material::name);
      if (before != scene.materials.end() && before->density != after->density)
        report.problem(key + ".material",
                       fmt::format("gives region '{}' the density {} of '{}' instead of {}; must "
                                   "keep it, as mass is conserved",
                                   name, number_text(after->density), material,
                                   number_text(before->density)));
    }
  }
}

void check_stages(const Scene& scene, SceneReport& report) {
  double end = 0.0;
  bool fixed = true; // whether the end of the stage before is known
  std::string continued;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const Stage& stage = scene.stages[i];
    const std::string key = item_key("stage", scene.stages, i);
    if (stage.start && fixed && stage.begin_from.empty() &&
        report.usable({key + ".start_s", "stage"}) && std::abs(*stage.start - end) > 1e-9 * end)
      report.problem(key + ".start_s",
                     fmt::format("is {}, {} the stage before, which ends at {} s; must be {}",
                                 number_text(*stage.start),
                                 *stage.start < end ? "and overlaps" : "and leaves a gap after",
                                 number_text(end), number_text(end)));
    end += stage.duration;
    fixed = fixed && !stage.until_rest && report.usable({key + ".duration_s"});
    if (stage.until_rest && scene.timing.rest_energy_fraction == 0.0)
      report.problem(key + ".until_rest", "is true; must be false unless "
                                          "time.rest_energy_fraction says what rest is");
    if (report.usable({key + ".body_force", "region"}))
      for (const auto& entry : stage.body_force)
        if (!has_name(scene.regions, entry.first))
          report.problem(key + ".body_force", unknown_name(entry.first, scene.regions, "region"));
    check_stage_materials(scene, stage, key, report);
    if (!stage.begin_from.empty() && !continued.empty())
      report.problem(key + ".begin_from",
                     fmt::format("is given as {}.begin_from is; must be given once", continued));
    if (!stage.begin_from.empty()) continued = key;
    if (i == 0 && !stage.begin_from.empty() && report.usable({"method.initial_stress"}) &&
        scene.method.initial_stress != InitialStress::none)
      report.problem("method.initial_stress",
                     fmt::format("is 'static', and {}.begin_from brings a stress along; must be "
                                 "'none'",
                                 key));
  }
}

void check_method(const Method& method, SceneReport& report) {
  if (report.usable({"method.precision", "method.shape"}) &&
      method.precision == Precision::single && method.shape == ShapeFunctions::gimp)
    report.problem(
        "method.precision",
        "single precision goes with the shape functions 'linear' and 'bspline' only, not 'gimp'");
  if (report.usable({"method.transfer", "method.shape"}) &&
      method.transfer != VelocityTransfer::flip && method.shape == ShapeFunctions::linear)
    report.problem("method.transfer",
                   "is affine with linear shape functions, whose gradients jump between cells: "
                   "slides blow up; must be 'flip' unless method.shape is 'bspline' or 'gimp'");
}

template <typename Item>
void check_names(const std::string& section, const std::vector<Item>& items, SceneReport& report) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto first = std::ranges::find(items, items[i].name, &Item::name) - items.begin();
    if (!items[i].name.empty() && first < static_cast<long>(i))
      report.problem(item_key(section, items, i) + ".name",
                     fmt::format("is '{}', as that of {}.{}; must be the only one of its name",
                                 items[i].name, section, first));
  }
}

void check_evolution(const std::string& key, const DruckerPrager& soil, SceneReport& report) {
  const Softening& residual = soil.residual;
  const auto given = [](double value) { return !std::isinf(value); };
  const std::string last = key + ".residual_plastic_strain";
  const std::vector<std::pair<std::string, double>> values = {
      {"cohesion_Pa", residual.cohesion},
      {"friction_angle_deg", residual.friction_angle},
      {"dilation_angle_deg", residual.dilation_angle}};
  for (const auto& [name, value] : values)
    if (given(value) && !given(residual.residual_strain) && report.usable({last}))
      report.problem(fmt::format("{}.residual_{}", key, name),
                     "has no effect without residual_plastic_strain, the strain at which it holds");
  if (report.usable({last, key + ".peak_plastic_strain"}) &&
      residual.peak_strain >= residual.residual_strain)
    report.problem(last, fmt::format("is {}; must be above peak_plastic_strain, {}",
                                     number_text(residual.residual_strain),
                                     number_text(residual.peak_strain)));
  const std::string dilation = key + ".residual_dilation_angle_deg";
  if (report.usable({dilation, key + ".dilation_angle_deg", key + ".friction_angle_deg",
                     key + ".residual_friction_angle_deg"})) {
    const DruckerPrager later = soil.at_residual();
    if (later.dilation_angle > later.friction_angle && soil.dilation_angle <= soil.friction_angle)
      report.problem(
          given(residual.dilation_angle) ? dilation : key + ".residual_friction_angle_deg",
          fmt::format("leaves a residual dilation angle of {} and a residual friction angle of {}; "
                      "dilation must be at most friction",
                      number_text(later.dilation_angle), number_text(later.friction_angle)));
  }
  const std::string diameter = key + ".grain_diameter_m";
  if (report.usable({diameter, key + ".rate_strengthening"}) && soil.rate_strengthening > 0.0 &&
      soil.grain_diameter == 0.0)
    report.problem(key + ".rate_strengthening",
                   "has no effect without grain_diameter_m, the diameter of the grains");
  if (given(soil.rate_strengthening_limit) && soil.rate_strengthening == 0.0)
    report.problem(key + ".rate_strengthening_limit", "has no effect without rate_strengthening");
}

void check_materials(const std::vector<Material>& materials, SceneReport& report) {
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const auto* soil = std::get_if<DruckerPrager>(&materials[i].law);
    if (soil == nullptr) continue;
    const std::string key = item_key("material", materials, i);
    const std::string dilation = key + ".dilation_angle_deg";
    if (report.usable({dilation, key + ".friction_angle_deg"}) &&
        soil->dilation_angle > soil->friction_angle)
      report.problem(dilation, fmt::format("is {}; must be at most the friction angle, {}",
                                           number_text(soil->dilation_angle),
                                           number_text(soil->friction_angle)));
    check_evolution(key, *soil, report);
  }
}

void check_shape(const std::string& key, const Region& region, SceneReport& report) {
  const Polygon& polygon = region.polygon;
  if (is_flat(polygon)) {
    report.problem(key, "has no area; must enclose some");
  } else if (polygon.front() == polygon.back()) {
    report.problem(key, "ends with its first corner; must name every corner once");
  } else if (const auto crossing = crossing_edges(polygon)) {
    report.problem(key, fmt::format("crosses or touches itself: edges {} and {}, counted from 0; "
                                    "must be a simple polygon",
                                    crossing->first, crossing->second));
  }
}

void check_inside(const std::string& shape, const std::string& depth, const Region& region,
                  const Grid& grid, SceneReport& report) {
  const auto outside = std::ranges::find_if(region.polygon, [&](const auto& corner) {
    return !within(grid, 0, corner[0]) || !within(grid, 2, corner[1]);
  });
  if (outside != region.polygon.end())
    report.problem(shape, fmt::format("has the corner [{}, {}] outside the grid, where {} and {}; "
                                      "must lie inside",
                                      number_text((*outside)[0]), number_text((*outside)[1]),
                                      extent(grid, 0), extent(grid, 2)));
  if (grid.dimension == 3 &&
      (!within(grid, 1, region.depth[0]) || !within(grid, 1, region.depth[1])))
    report.problem(depth, fmt::format("runs from {} to {}, outside the grid, where {}; must lie "
                                      "inside",
                                      number_text(region.depth[0]), number_text(region.depth[1]),
                                      extent(grid, 1)));
}

void check_regions(const Scene& scene, SceneReport& report) {
  std::vector<std::string> materials;
  for (const Material& material : scene.materials) materials.push_back(material.name);
  const bool materials_named =
      report.usable({"material"}) && std::ranges::find(materials, "") == materials.end();

  double points = 0.0;
  for (std::size_t i = 0; i < scene.regions.size(); ++i) {
    const Region& region = scene.regions[i];
    const std::string key = item_key("region", scene.regions, i);
    const bool known = std::ranges::find(materials, region.material) != materials.end();
    if (report.usable({key + ".material"}) && materials_named && !known) {
      const std::string hint = did_you_mean(region.material, materials);
      report.problem(key + ".material",
                     fmt::format("is '{}'; must be the name of a [[material]]: {}{}",
                                 region.material, quoted_list(materials, "or"),
                                 hint.empty() ? "" : " (" + hint + ")"));
    }
    const bool is_box = report.placed(key + ".box_m");
    const std::string shape = key + (is_box ? ".box_m" : ".polygon_m");
    const std::string depth = key + (is_box ? ".box_m" : ".depth_m");
    if (!report.usable({shape, depth})) continue;
    check_shape(shape, region, report);
    if (!grid_usable(report)) continue;
    check_inside(shape, depth, region, scene.grid, report);
    const double spacing = scene.grid.cell_size / scene.grid.points_per_cell;
    const double layers =
        scene.grid.dimension == 3 ? (region.depth[1] - region.depth[0]) / spacing : 1.0;
    points += area(region.polygon) / (spacing * spacing) * layers;
  }
  if (points > most_points)
    report.problem(
        "grid.points_per_cell",
        fmt::format("makes about {:.3g} points; must make at most {:.0e}", points, most_points));
}

void check_gates(const Scene& scene, SceneReport& report) {
  for (std::size_t i = 0; i < scene.gates.size(); ++i) {
    const Gate& gate = scene.gates[i];
    const std::string key = item_key("gate", scene.gates, i);
    if (!report.usable({key + ".axis", "grid.dimension"})) continue;
    if (gate.axis == 1 && scene.grid.dimension == 2) {
      report.problem(key + ".axis", "is 'y', which plane strain has not; must be 'x' or 'z'");
      continue;
    }
    if (!grid_usable(report) || !report.usable({key + ".position_m"})) continue;
    const auto axis = static_cast<std::size_t>(gate.axis);
    const double cells =
        std::round((gate.position - scene.grid.lower[axis]) / scene.grid.cell_size);
    if (!within(scene.grid, axis, gate.position))
      report.problem(key + ".position_m",
                     fmt::format("is {}, outside the grid, where {}; must lie inside",
                                 number_text(gate.position), extent(scene.grid, axis)));
    else if (!on_grid_plane(scene.grid, axis, gate.position))
      report.problem(key + ".position_m",
                     fmt::format("is {}, between two grid planes; must lie on one, such as {:.10g}",
                                 number_text(gate.position),
                                 scene.grid.lower[axis] + cells * scene.grid.cell_size));
  }
}

bool shapes_usable(const Scene& scene, const SceneReport& report) {
  if (!report.usable({"region"})) return false;
  for (std::size_t i = 0; i < scene.regions.size(); ++i) {
    const std::string key = item_key("region", scene.regions, i);
    if (!report.usable({key + ".polygon_m", key + ".box_m"})) return false;
  }
  return true;
}

/// In the x-z plane; extruded regions are not looked at along y.
double distance_to_body(const Scene& scene, const std::array<double, 3>& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const Region& region : scene.regions)
    least = std::min(least, distance(region.polygon, {place[0], place[2]}));
  return least;
}

void check_monitors(const Scene& scene, SceneReport& report) {
  for (std::size_t i = 0; i < scene.monitors.size(); ++i) {
    const std::string key = item_key("monitor", scene.monitors, i) + ".position_m";
    if (!grid_usable(report) || !report.usable({key})) continue;
    for (const std::size_t axis : axes_of(scene.grid)) {
      const double position = scene.monitors[i].position[axis];
      if (!within(scene.grid, axis, position))
        report.problem(key, fmt::format("has {} = {}, outside the grid, where {}; must lie inside",
                                        axis_names[axis], number_text(position),
                                        extent(scene.grid, axis)));
    }
    if (!report.usable({key}) || !shapes_usable(scene, report)) continue;
    const double away = distance_to_body(scene, scene.monitors[i].position);
    if (away > scene.grid.cell_size)
      report.problem(key, fmt::format("lies {:.4g} m outside the body; must lie in a region, or "
                                      "within a cell of one",
                                      away));
  }
}

} // namespace

void check_scene(const Scene& scene, SceneReport& report) {
  check_grid(scene.grid, report);
  check_time(scene, report);
  check_method(scene.method, report);
  check_names("material", scene.materials, report);
  check_names("region", scene.regions, report);
  check_names("gate", scene.gates, report);
  check_names("stage", scene.stages, report);
  check_names("monitor", scene.monitors, report);
  check_materials(scene.materials, report);
  check_regions(scene, report);
  check_gates(scene, report);
  check_stages(scene, report);
  check_monitors(scene, report);
  if (report.usable({"output.front_regions", "region"}))
    for (const std::string& name : scene.output.front_regions)
      if (!has_name(scene.regions, name))
        report.problem("output.front_regions", unknown_name(name, scene.regions, "region"));
}

} // namespace scarp::io
