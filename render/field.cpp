#include "render/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

namespace scarp::render {

namespace {

struct Quantity {
  const char* name;
  const char* label;
  const char* unit;
};

constexpr std::array<Quantity, 16> quantities = {{
    {"equivalent_plastic_strain", "equivalent plastic strain", "-"},
    {"displacement", "displacement", "m"},
    {"velocity", "velocity", "m/s"},
    {"acceleration", "acceleration", "m/s²"},
    {"stress", "stress", "Pa"},
    {"mean_stress", "mean stress", "Pa"},
    {"deviatoric_stress", "deviatoric stress", "Pa"},
    {"strain", "strain", "-"},
    {"volumetric_strain", "volumetric strain", "-"},
    {"volume_ratio", "volume ratio", "-"},
    {"density", "density", "kg/m³"},
    {"mass", "mass", "kg"},
    {"volume", "volume", "m³"},
    {"initial_volume", "initial volume", "m³"},
    {"region", "region", "-"},
    {"material", "material", "-"},
}};

const Quantity* quantity(const std::string& name) {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const Quantity& known) { return name == known.name; });
  return found == quantities.end() ? nullptr : &*found;
}

/// Units that read better where values are large or small.
struct Multiple {
  const char* unit;
  const char* of;
  double size;
};

constexpr std::array<Multiple, 6> multiples = {{{"kPa", "Pa", 1e3},
                                                {"MPa", "Pa", 1e6},
                                                {"mm", "m", 1e-3},
                                                {"cm", "m", 1e-2},
                                                {"mm/s", "m/s", 1e-3},
                                                {"%", "-", 1e-2}}};

/// Of the field's unit in the column's.
double unit_size(const Field& field) {
  const std::string own = field_unit({field.name, field.component});
  if (field.unit.empty() || field.unit == own) return 1.0;
  for (const Multiple& multiple : multiples)
    if (field.unit == multiple.unit && own == multiple.of) return multiple.size;
  throw std::invalid_argument(
      fmt::format("{} in {} cannot be drawn in {}", field.name, own, field.unit));
}

constexpr std::array<const char*, 3> vector_components = {"x", "y", "z"};
constexpr std::array<const char*, 6> tensor_components = {"xx", "yy", "zz", "xy", "yz", "xz"};
constexpr std::array<const char*, 9> gradient_components = {"xx", "xy", "xz", "yx", "yy",
                                                            "yz", "zx", "zy", "zz"};
/// Of a tensor in the plane x-z; its other shear components are zero.
constexpr std::array<const char*, 6> plane_components = {
    "horizontal {}", "out-of-plane {}", "vertical {}", "{} xy", "{} yz", "shear {}"};

/// Empty if columns of so many components have no names for them.
std::span<const char* const> component_names(int components) {
  switch (components) {
  case 3:
    return vector_components;
  case 6:
    return tensor_components;
  case 9:
    return gradient_components;
  default:
    return {};
  }
}

} // namespace

void require_component(const io::Column& column, int component) {
  const bool has_magnitude = column.components <= 3;
  if (component < column.components && component >= (has_magnitude ? -1 : 0)) return;
  const std::span<const char* const> names = component_names(column.components);
  std::vector<std::string> known;
  known.reserve(static_cast<std::size_t>(column.components) + 1);
  for (int c = 0; c < column.components; ++c)
    known.push_back(names.empty() ? fmt::format("{}", c)
                                  : fmt::format("{} ({})", c, names[static_cast<std::size_t>(c)]));
  if (has_magnitude) known.emplace_back(column.components == 1 ? "-1" : "-1 (magnitude)");
  const std::string last = known.back();
  known.pop_back();
  throw std::invalid_argument(
      fmt::format("{} has no {}; must be {} or {}", column.name,
                  component == -1 ? "magnitude" : fmt::format("component {}", component),
                  fmt::join(known, ", "), last));
}

std::vector<double> field_values(const io::Frame& frame, const Field& field) {
  const io::Column& column = frame.column(field.name);
  require_component(column, field.component);
  const double unit = unit_size(field);
  const auto components = static_cast<std::size_t>(column.components);
  std::vector<double> values(frame.size());
  for (std::size_t p = 0; p < values.size(); ++p) {
    const double* const all = column.values.data() + components * p;
    if (field.component >= 0 || components == 1) {
      values[p] = all[std::max(field.component, 0)] / unit;
      continue;
    }
    double sum = 0.0;
    for (std::size_t c = 0; c < components; ++c) sum += all[c] * all[c];
    values[p] = std::sqrt(sum) / unit;
  }
  return values;
}

std::string field_label(const io::Frame& frame, const Field& field) {
  const Quantity* const known = quantity(field.name);
  std::string label = known != nullptr ? known->label : field.name;
  std::replace(label.begin(), label.end(), '_', ' ');
  const int components = frame.column(field.name).components;
  if (components == 1) return label;
  if (field.component < 0) return label + " magnitude";
  const auto c = static_cast<std::size_t>(field.component);
  if (components == 3) return label + " " + vector_components.at(c);
  if (components == 9) return label + " " + gradient_components.at(c);
  if (frame.dimension == 3) return label + " " + tensor_components.at(c);
  return fmt::format(fmt::runtime(plane_components.at(c)), label);
}

std::string field_unit(const Field& field) {
  if (!field.unit.empty()) return field.unit;
  const Quantity* const known = quantity(field.name);
  return known != nullptr ? known->unit : "";
}

bool is_category(const Field& field) { return field.name == "region" || field.name == "material"; }

ValueSpread value_spread(const io::Frame& frame, const Field& field) {
  std::vector<double> values = field_values(frame, field);
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {};
  const std::size_t cut = values.size() / 100;
  const auto rank = [&](std::size_t place) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  ValueSpread spread = {*least, *largest, 0.0, 0.0};
  spread.low = rank(cut);
  spread.high = rank(values.size() - 1 - cut);
  return spread;
}

ValueSpread united(const ValueSpread& a, const ValueSpread& b) {
  return {std::min(a.least, b.least), std::max(a.largest, b.largest), std::min(a.low, b.low),
          std::max(a.high, b.high)};
}

std::vector<double> ColourRange::edges() const {
  std::vector<double> values;
  for (int band = 0; band <= bands; ++band)
    values.push_back(lower + (upper - lower) * band / bands);
  return values;
}

ColourRange round_range(const ValueSpread& spread, int most_bands) {
  constexpr double near = 0.5; // of the far end: an axis from 0 then wastes less than half
  double low = spread.low;
  double high = spread.high;
  if (low >= 0.0 && low <= near * high) low = 0.0;
  if (high <= 0.0 && high >= near * low) high = 0.0;
  if (!(high > low)) high = low + std::max(1.0, std::abs(low));

  // Widths with few digits, closer together than those of axes so that few colours lie idle.
  constexpr std::array<double, 10> factors = {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
  const double least_width = (high - low) / most_bands;
  constexpr double slack = 1e-9;
  for (double power = std::pow(10.0, std::floor(std::log10(least_width)));; power *= 10.0) {
    for (const double factor : factors) {
      const double width = factor * power;
      const double first = std::floor(low / width + slack);
      const double last = std::ceil(high / width - slack);
      if (last - first > most_bands) continue;
      ColourRange range = {first * width, last * width, static_cast<int>(last - first)};
      range.values_below = spread.least < range.lower - slack * width;
      range.values_above = spread.largest > range.upper + slack * width;
      return range;
    }
  }
}

ColourRange common_range(std::span<const io::Frame> frames, const Field& field, int most_bands) {
  if (frames.empty()) return round_range({}, most_bands);
  ValueSpread spread = value_spread(frames.front(), field);
  for (const io::Frame& frame : frames.subspan(1))
    spread = united(spread, value_spread(frame, field));
  if (!is_category(field)) return round_range(spread, most_bands);
  const double first = std::round(spread.least);
  const auto bands = static_cast<int>(std::lround(spread.largest - first)) + 1;
  return {first - 0.5, first - 0.5 + bands, bands};
}

} // namespace scarp::render
