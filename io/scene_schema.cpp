#include "io/scene_schema.hpp"

#include "core/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace scarp::io {
namespace {

Section<Scene> top_section() {
  return {.name = "",
          .help = "Options of the whole scene, before the first section.",
          .options = {
              Declaration<Scene>{
                  .key = "title",
                  .unit = "",
                  .allowed = "a string",
                  .help = "A line for people: it heads figures and listings.",
                  .read = [](const toml::node& node, int,
                             Scene& scene) { return read_text_value(node, scene.title); },
                  .write = [](const Scene& scene, int) -> Json { return scene.title; }},
              vector<Scene>("gravity_m_s2", "m/s2", &Scene::gravity,
                            "Gravity; in plane strain [x, 0, z] is allowed as well.", read_gravity),
          }};
}

Section<Grid> grid_section() {
  return {.name = "grid",
          .help = "The background grid of square or cubic cells, and the lattice of points.",
          .options = {
              whole_number<Grid>("dimension", &Grid::dimension, 2, 3,
                                 "2: plane strain in x and z; 3: x, y and z. z points up."),
              required(number<Grid>("cell_size_m", "m", &Grid::cell_size, {.above = 0},
                                    "Edge of a cell.")),
              required(vector<Grid>("lower_m", "m", &Grid::lower, "Lower corner of the grid.")),
              required(vector<Grid>("upper_m", "m", &Grid::upper,
                                    "Upper corner, a whole number of cells from the lower one.")),
              whole_number<Grid>("points_per_cell", &Grid::points_per_cell, 1, 10,
                                 "Material points along each edge of a filled cell."),
          }};
}

Option<Grid> wall(std::string key, std::size_t axis, std::size_t side, std::string help) {
  return Declaration<Grid>{
      .key = std::move(key),
      .unit = "",
      .allowed = "'fixed', 'symmetry', 'free' or { kind = 'friction', coefficient = NUMBER >= 0 }",
      .help = std::move(help),
      .read = [=](const toml::node& node, int,
                  Grid& grid) { return read_wall(node, grid.walls[axis][side]); },
      .write = [=](const Grid& grid, int) -> Json {
        const Wall& w = grid.walls[axis][side];
        const std::string& kind = wall_words[static_cast<std::size_t>(w.kind)];
        if (w.kind != WallKind::friction) return kind;
        return {{"kind", kind}, {"coefficient", w.friction_coefficient}};
      }};
}

Section<Grid> walls_section() {
  return {.name = "walls",
          .help = "What the sides of the grid do. 'fixed': no velocity; 'symmetry': no velocity "
                  "across; 'free': nothing; friction: no velocity into the wall, Coulomb friction "
                  "along it.",
          .options = {
              wall("x_lower", 0, 0, "Left side."),
              wall("x_upper", 0, 1, "Right side."),
              only_in_3d(wall("y_lower", 1, 0, "Front side.")),
              only_in_3d(wall("y_upper", 1, 1, "Back side.")),
              wall("z_lower", 2, 0, "Bottom."),
              wall("z_upper", 2, 1, "Top."),
          }};
}

Option<Timing> end_time() {
  Option<Timing> option = number<Timing>(
      "end_s", "s", &Timing::end_time, {.above = 0},
      "Time at which the run ends. Required without [[stage]], to be left out with.");
  option.write = [](const Timing& timing, int) -> Json {
    return timing.end_time > 0.0 ? Json(timing.end_time) : Json();
  };
  return option;
}

Section<Timing> time_section() {
  return {
      .name = "time",
      .help = "Length of the run and of its steps.",
      .options = {
          end_time(),
          required(number<Timing>("output_interval_s", "s", &Timing::output_interval, {.above = 0},
                                  "Time between frames, at most the whole run.")),
          number<Timing>("history_interval_s", "s", &Timing::history_interval, {.at_least = 0},
                         "Time between rows of history.csv; 0: a tenth of output_interval_s."),
          number<Timing>("cfl", "", &Timing::cfl, {.above = 0, .at_most = 1},
                         "Time step as a part of the critical one."),
          number<Timing>("max_step_s", "s", &Timing::max_time_step,
                         {.above = 0, .infinity = "no limit"}, "Largest time step."),
          number<Timing>("rest_energy_fraction", "", &Timing::rest_energy_fraction,
                         {.at_least = 0, .below = 1},
                         "The run (with stages: one until rest) ends early once the kinetic energy "
                         "has stayed below this part of its peak for rest_duration_s; 0: never."),
          number<Timing>("rest_duration_s", "s", &Timing::rest_duration, {.at_least = 0},
                         "How long the scene must be at rest; see rest_energy_fraction."),
      }};
}

/// First of its section, since it sets all the others.
Option<Method> preset_option() {
  Option<Method> option = word<Method, Preset>(
      "preset", &Method::preset, {{"accurate", Preset::accurate}, {"fidelity", Preset::fidelity}},
      "What the other options of this section are where they are not given: accurate (B-splines "
      "and "
      "APIC, the default) or fidelity (as published for landslides: linear functions and FLIP).");
  const auto read = option.read;
  option.read = [read](const toml::node& node, int dimension, Method& method) {
    Complaint wrong = read(node, dimension, method);
    if (!wrong) method = method_of(method.preset);
    return wrong;
  };
  return option;
}

Section<Method> method_section() {
  Section<Method> section = {
      .name = "method",
      .help = "The numerical scheme.",
      .options = {
          preset_option(),
          word<Method, Scheme>(
              "scheme", &Method::scheme,
              {{"usf", Scheme::usf}, {"usl", Scheme::usl}, {"musl", Scheme::musl}},
              "When stress is updated: before the momentum (usf), after it (usl), or after it with "
              "the points' new momenta mapped to the grid again (musl)."),
          word<Method, ShapeFunctions>("shape", &Method::shape,
                                       {{"linear", ShapeFunctions::linear},
                                        {"gimp", ShapeFunctions::gimp},
                                        {"bspline", ShapeFunctions::bspline}},
                                       "Shape functions of the grid: linear, uniform GIMP, or "
                                       "quadratic B-splines."),
          word<Method, VolumeRate>(
              "volume_rate", &Method::volume_rate,
              {{"point", VolumeRate::point}, {"cell_average", VolumeRate::cell_average}},
              "The rate of volume of a point: its own, or the mean of its "
              "cell, against volumetric locking."),
          word<Method, VelocityTransfer>(
              "transfer", &Method::transfer,
              {{"flip", VelocityTransfer::flip},
               {"apic", VelocityTransfer::apic},
               {"aflip", VelocityTransfer::aflip}},
              "What points and nodes exchange: velocities (flip), these with "
              "their gradients and no FLIP (apic), or both (aflip)."),
          word<Method, Precision>(
              "precision", &Method::precision,
              {{"double", Precision::double_precision}, {"single", Precision::single}},
              "Numbers of points and nodes; positions are double in both. Single "
              "goes with linear and bspline."),
          word<Method, InitialStress>(
              "initial_stress", &Method::initial_stress,
              {{"none", InitialStress::none}, {"static", InitialStress::equilibrium}},
              "The stress at time 0: none, or that of the static equilibrium under the loads of "
              "time 0. Strains, displacements and gaps count from there."),
          number<Method>("flip", "", &Method::flip, {.at_least = 0, .at_most = 1},
                         "Part of FLIP in the velocity update; the rest is PIC. Not used by apic."),
          number<Method>("local_damping", "", &Method::local_damping, {.at_least = 0, .below = 1},
                         "Cundall's non-viscous damping of the nodal forces."),
          number<Method>("settling_damping", "", &Method::settling_damping,
                         {.at_least = 0, .below = 1},
                         "The same while a gate has still to open; the larger of the two counts."),
      }};
  for (Option<Method>& option : section.options) option.example = default_scene().method;
  return section;
}

using Law = decltype(Material::law);

const std::vector<std::pair<std::string, Law>>& laws() {
  static const std::vector<std::pair<std::string, Law>> all = {{"linear_elastic", LinearElastic{}},
                                                               {"drucker_prager", DruckerPrager{}}};
  return all;
}

Option<Material> law_option() {
  std::vector<std::string> names;
  for (const auto& entry : laws()) names.push_back(entry.first);
  return Declaration<Material>{.key = "law",
                               .unit = "",
                               .allowed = quoted_list(names, "or"),
                               .help = "The stress-strain law.",
                               .read =
                                   [names](const toml::node& node, int, Material& material) {
                                     std::size_t index = 0;
                                     Complaint wrong = read_word(node, names, index);
                                     if (!wrong) material.law = laws()[index].second;
                                     return wrong;
                                   },
                               .write = [names](const Material& material, int) -> Json {
                                 for (const auto& [name, law] : laws())
                                   if (law.index() == material.law.index()) return name;
                                 return nullptr;
                               }};
}

// A material of this law may, others must not have the option.
template <typename OneLaw> Option<Material> only_with(Option<Material> option) {
  for (const auto& [name, law] : laws())
    if (std::holds_alternative<OneLaw>(law)) option.condition = fmt::format("law = \"{}\"", name);
  option.condition_key = "law";
  option.exists = [](const Material& material, int) {
    return std::holds_alternative<OneLaw>(material.law);
  };
  option.example.law = OneLaw{};
  return option;
}

template <typename OneLaw, typename Value> auto of_law(Value OneLaw::*member) {
  return [member](auto& material) -> auto& { return std::get<OneLaw>(material.law).*member; };
}

Option<Material> bulk_modulus() {
  const Range range{.above = 0};
  return instead_of<Material>(
      {"youngs_modulus_Pa"},
      Declaration<Material>{.key = "bulk_modulus_Pa",
                            .unit = "Pa",
                            .allowed = range.text("Pa"),
                            .help = "Bulk modulus K, from which E = 3 K (1 - 2 nu).",
                            .read =
                                [range](const toml::node& node, int, Material& material) {
                                  double bulk = 0.0;
                                  Complaint wrong = read_number(node, range, bulk);
                                  material.youngs_modulus =
                                      3.0 * bulk * (1.0 - 2.0 * material.poissons_ratio);
                                  return wrong;
                                },
                            .write = [](const Material&, int) -> Json { return nullptr; }});
}

Section<Material> material_section() {
  const Range poisson{.above = -1, .below = 0.5, .hint = "0.5 is incompressible: take 0.49"};
  // Young's modulus follows from the bulk modulus and Poisson's ratio, which is therefore read
  // first.
  return {
      .name = "material",
      .help = "A material; one [[material]] for each.",
      .options =
          {
              name<Material>("What regions call it."),
              required(law_option()),
              required(number<Material>("density_kg_m3", "kg/m3", &Material::density, {.above = 0},
                                        "Density before loading.")),
              required(number<Material>("poissons_ratio", "", &Material::poissons_ratio, poisson,
                                        "Poisson's ratio nu.")),
              required(number<Material>("youngs_modulus_Pa", "Pa", &Material::youngs_modulus,
                                        {.above = 0}, "Young's modulus E.")),
              bulk_modulus(),
              only_with<DruckerPrager>(
                  required(number<Material>("cohesion_Pa", "Pa", of_law(&DruckerPrager::cohesion),
                                            {.at_least = 0}, "Cohesion c of Mohr-Coulomb."))),
              only_with<DruckerPrager>(required(number<Material>(
                  "friction_angle_deg", "deg", of_law(&DruckerPrager::friction_angle),
                  {.at_least = 0, .below = 90}, "Friction angle of Mohr-Coulomb."))),
              only_with<DruckerPrager>(number<Material>(
                  "dilation_angle_deg", "deg", of_law(&DruckerPrager::dilation_angle),
                  {.at_least = 0, .below = 90}, "Dilation angle, at most the friction angle.")),
              only_with<DruckerPrager>(word<Material, Cone>(
                  "cone", of_law(&DruckerPrager::cone),
                  {{"inscribed", Cone::inscribed},
                   {"circumscribed", Cone::circumscribed},
                   {"plane_strain", Cone::plane_strain}},
                  "Which cone stands for Mohr-Coulomb: inscribed or "
                  "circumscribed in the pi plane, or matched in plane strain.")),
              only_with<DruckerPrager>(number<Material>(
                  "tension_cutoff_Pa", "Pa", of_law(&DruckerPrager::tension_cutoff),
                  {.at_least = 0, .infinity = "the apex of the cone"},
                  "Largest mean stress, tension positive; the apex bounds it.")),
              only_with<DruckerPrager>(word<Material, Opening>(
                  "opening", of_law(&DruckerPrager::opening),
                  {{"forgotten", Opening::forgotten}, {"remembered", Opening::remembered}},
                  "Whether a gap opened at the tension cut-off has to close before the material "
                  "bears pressure again.")),
          },
      .needed = true};
}

Option<Region> box() {
  return instead_of<Region>(
      {"polygon_m", "depth_m"},
      Declaration<Region>{
          .key = "box_m",
          .unit = "m",
          .allowed = "two corners [[x, z], [x, z]] (3-D: [[x, y, z], [x, y, z]]), the lower first, "
                     "finite numbers in m",
          .help = "A box, for a polygon of four corners and a depth.",
          .read = read_box,
          .write = [](const Region&, int) -> Json { return nullptr; }});
}

Option<Region> polygon() {
  return Declaration<Region>{
      .key = "polygon_m",
      .unit = "m",
      .allowed = "at least three corners [[x, z], [x, z], [x, z], ...], finite numbers in m",
      .help = "A simple polygon in the x-z plane, either way round.",
      .read = [](const toml::node& node, int,
                 Region& region) { return read_polygon(node, region.polygon); },
      .write = [](const Region& region, int) -> Json { return region.polygon; }};
}

Option<Region> depth() {
  return Declaration<Region>{
      .key = "depth_m",
      .unit = "m",
      .allowed = "[y, y], the lower first, finite numbers in m",
      .help = "Extent of the polygon along y.",
      .read = [](const toml::node& node, int,
                 Region& region) { return read_interval(node, region.depth); },
      .write = [](const Region& region, int) -> Json { return region.depth; }};
}

Section<Region> region_section() {
  return {.name = "region",
          .help =
              "A part of the body; one [[region]] for each. A point belongs to the first region "
              "that holds it.",
          .options =
              {
                  name<Region>("Name in messages and overrides."),
                  required<Region>(Declaration<Region>{
                      .key = "material",
                      .unit = "",
                      .allowed = "the name of a [[material]]",
                      .help = "What it is made of.",
                      .read = [](const toml::node& node, int,
                                 Region& region) { return read_text_value(node, region.material); },
                      .write = [](const Region& region, int) -> Json { return region.material; }}),
                  required(polygon()),
                  only_in_3d(required(depth())),
                  box(),
                  vector<Region>("velocity_m_s", "m/s", &Region::velocity, "Velocity at time 0."),
              },
          .needed = true};
}

Section<Gate> gate_section() {
  return {.name = "gate",
          .help = "A plane across the grid that acts as a symmetry plane until it is taken away; "
                  "any number of [[gate]].",
          .options = {
              name<Gate>("Name in messages and overrides."),
              word<Gate, int>("axis", &Gate::axis, {{"x", 0}, {"y", 1}, {"z", 2}},
                              "The axis that the plane is normal to; y in 3-D only."),
              required(number<Gate>("position_m", "m", &Gate::position, {},
                                    "Coordinate of the plane, on a grid plane.")),
              required(number<Gate>("release_time_s", "s", &Gate::release_time, {.at_least = 0},
                                    "When it is taken away.")),
          }};
}

// A ramp that `member` finds in a stage.
template <typename Member>
Option<Stage> ramp(const std::string& key, Member member, const std::string& help) {
  return Declaration<Stage>{
      .key = key,
      .unit = "",
      .allowed = ramp_rule,
      .help = help,
      .read = [=](const toml::node& node, int,
                  Stage& stage) { return read_ramp(node, std::invoke(member, stage)); },
      .write = [=](const Stage& stage, int) { return ramp_json(std::invoke(member, stage)); }};
}

Option<Stage> body_forces() {
  return Declaration<Stage>{
      .key = "body_force",
      .unit = "",
      .allowed = std::string("{ REGION = FACTOR, ... }, each FACTOR ") + ramp_rule,
      .help = "Further multiples of gravity, by region; those not named have 1.",
      .read = [](const toml::node& node, int,
                 Stage& stage) { return read_ramps(node, stage.body_force); },
      .write = [](const Stage& stage, int) -> Json {
        Json values = Json::object();
        for (const auto& [region, factor] : stage.body_force) values[region] = ramp_json(factor);
        return values;
      }};
}

Option<Stage> stage_materials() {
  return Declaration<Stage>{
      .key = "material",
      .unit = "",
      .allowed = "{ REGION = 'MATERIAL', ... }",
      .help =
          "Materials during this stage, by region; those not named keep [[region]]'s. Stress and "
          "state go over.",
      .read = [](const toml::node& node, int,
                 Stage& stage) { return read_names(node, stage.material); },
      .write = [](const Stage& stage, int) -> Json {
        Json values = Json::object();
        for (const auto& [region, material] : stage.material) values[region] = material;
        return values;
      }};
}

Option<Stage> stage_start() {
  const Range range{.at_least = 0};
  return Declaration<Stage>{
      .key = "start_s",
      .unit = "s",
      .allowed = range.text("s"),
      .help = "When it starts, for the reader: the end of the stage before.",
      .read = [range](const toml::node& node, int,
                      Stage& stage) { return read_number(node, range, stage.start.emplace()); },
      .write = [](const Stage& stage, int) -> Json {
        return stage.start ? Json(*stage.start) : Json();
      }};
}

Section<Stage> stage_section() {
  return {.name = "stage",
          .help =
              "A part of the run with its own loads and materials; any number of [[stage]], one "
              "after the other. Without, the run is one stage to time.end_s.",
          .options = {
              name<Stage>("Name in messages and overrides."),
              required(number<Stage>("duration_s", "s", &Stage::duration, {.above = 0},
                                     "How long it lasts.")),
              stage_start(),
              Declaration<Stage>{
                  .key = "until_rest",
                  .unit = "",
                  .allowed = "true or false",
                  .help = "Ends before duration_s is over, once the mass is at rest; "
                          "see time.rest_energy_fraction.",
                  .read = [](const toml::node& node, int,
                             Stage& stage) { return read_truth(node, stage.until_rest); },
                  .write = [](const Stage& stage, int) -> Json { return stage.until_rest; }},
              ramp("gravity", &Stage::gravity,
                   "Multiple of gravity_m_s2, time from the stage's start."),
              body_forces(),
              stage_materials(),
              Declaration<Stage>{
                  .key = "begin_from",
                  .unit = "",
                  .allowed = "a directory with one series, or a .pvd or .vtp file",
                  .help = "The run whose last frame this stage begins from: the same points, all "
                          "fields. Stages before this one are left out.",
                  .read = [](const toml::node& node, int,
                             Stage& stage) { return read_text_value(node, stage.begin_from); },
                  .write = [](const Stage& stage, int) -> Json {
                    return stage.begin_from.empty() ? Json() : Json(stage.begin_from);
                  }},
          }};
}

Section<Monitor> monitor_section() {
  return {.name = "monitor",
          .help = "A point to be followed in history.csv; any number of [[monitor]].",
          .options = {
              name<Monitor>("Name of its columns in history.csv."),
              required(vector<Monitor>(
                  "position_m", "m", &Monitor::position,
                  "Where it is at time 0: the nearest material point is followed.")),
          }};
}

std::vector<std::string> field_names() {
  std::vector<std::string> names;
  for (const FieldInfo& field : field_table()) names.push_back(field.name);
  return names;
}

Section<Output> output_section() {
  return {
      .name = "output",
      .help = "What the frames hold.",
      .options = {
          Declaration<Output>{
              .key = "fields",
              .unit = "",
              .allowed = "a list of different words out of " + quoted_list(field_names(), "and"),
              .help = "Fields to write; an empty list: all.",
              .read = [](const toml::node& node, int,
                         Output& output) { return read_words(node, field_names(), output.fields); },
              .write = [](const Output& output, int) -> Json { return output.fields; }},
          Declaration<Output>{
              .key = "front_regions",
              .unit = "",
              .allowed = "a list of different names of regions",
              .help = "Regions whose largest x is front_x_m in history.csv; an empty list: all.",
              .read = [](const toml::node& node, int,
                         Output& output) { return read_name_list(node, output.front_regions); },
              .write = [](const Output& output, int) -> Json { return output.front_regions; }}}};
}

} // namespace

const SceneSchema& scene_schema() {
  static const SceneSchema schema = {.top = top_section(),
                                     .grid = grid_section(),
                                     .walls = walls_section(),
                                     .time = time_section(),
                                     .method = method_section(),
                                     .material = material_section(),
                                     .region = region_section(),
                                     .gate = gate_section(),
                                     .stage = stage_section(),
                                     .monitor = monitor_section(),
                                     .output = output_section()};
  return schema;
}

Scene default_scene() {
  Scene scene;
  scene.method = method_of(Preset::accurate);
  return scene;
}

std::vector<std::string> excluded_by(const std::string& section, const std::string& key) {
  std::vector<std::string> excluded;
  const Scene scene;
  for_each_section(scene, [&]<typename T>(const Section<T>& declared, const auto&) {
    if (declared.name != section) return;
    for (const Option<T>& option : declared.options) {
      const std::vector<std::string>& replaced = option.instead_of;
      if (option.key == key) excluded.insert(excluded.end(), replaced.begin(), replaced.end());
      if (std::ranges::find(replaced, key) != replaced.end()) excluded.push_back(option.key);
    }
  });
  return excluded;
}

} // namespace scarp::io
