// What the body is made of and where it is.
#include "io/scene_sections.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace scarp::io {

namespace {

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

/// An option of what a Drucker-Prager material softens to.
Option<Material> softening(const std::string& key, const std::string& unit,
                           double Softening::*member, const Range& range, const std::string& help) {
  const auto of = [member](auto& material) -> auto& {
    return std::get<DruckerPrager>(material.law).residual.*member;
  };
  return only_with<DruckerPrager>(number<Material>(key, unit, of, range, help));
}

Option<Material> rate_limit() {
  return only_with<DruckerPrager>(number<Material>(
      "rate_strengthening_limit", "", of_law(&DruckerPrager::rate_strengthening_limit),
      {.above = 0, .infinity = "none"},
      "The most that shear over mean stress grows by; 0.28 for disks."));
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

} // namespace

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
              softening("residual_plastic_strain", "", &Softening::residual_strain,
                        {.above = 0, .infinity = "it does not soften"},
                        "Equivalent plastic strain at which strength and dilation have gone over "
                        "to their residual values, linearly."),
              softening("peak_plastic_strain", "", &Softening::peak_strain, {.at_least = 0},
                        "Equivalent plastic strain at which this begins."),
              softening("residual_cohesion_Pa", "Pa", &Softening::cohesion,
                        {.at_least = 0, .infinity = "as at first"}, "Cohesion after softening."),
              softening("residual_friction_angle_deg", "deg", &Softening::friction_angle,
                        {.at_least = 0, .below = 90, .infinity = "as at first"},
                        "Friction angle after softening."),
              softening("residual_dilation_angle_deg", "deg", &Softening::dilation_angle,
                        {.at_least = 0, .below = 90, .infinity = "as at first"},
                        "Dilation angle after softening; 0: a critical state."),
              only_with<DruckerPrager>(number<Material>(
                  "rate_strengthening", "", of_law(&DruckerPrager::rate_strengthening),
                  {.at_least = 0},
                  "Growth of shear over mean stress with the inertial number, grain_diameter_m "
                  "times the rate of shear times sqrt(density / pressure); about 1 for disks.")),
              rate_limit(),
              only_with<DruckerPrager>(number<Material>(
                  "grain_diameter_m", "m", of_law(&DruckerPrager::grain_diameter), {.at_least = 0},
                  "Diameter of the grains in the inertial number.")),
          },
      .needed = true};
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

} // namespace scarp::io
