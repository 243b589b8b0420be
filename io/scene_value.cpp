#include "io/scene_value.hpp"

#include "io/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace scarp::io {
namespace {

std::optional<double> as_number(const toml::node& node) {
  if (node.is_integer() || node.is_floating_point()) return node.value<double>();
  return std::nullopt;
}

// `count` finite numbers, or a complaint.
Complaint read_numbers(const toml::node& node, std::size_t count, std::vector<double>& values) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != count) return {"is " + shown(node)};
  values.clear();
  for (const toml::node& entry : *array) {
    const std::optional<double> number = as_number(entry);
    if (!number || !std::isfinite(*number)) return {"holds " + shown(entry)};
    values.push_back(*number);
  }
  return {};
}

std::size_t size_of(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array == nullptr ? 0 : array->size();
}

} // namespace

bool Range::contains(double value) const {
  if (std::isinf(value)) return value > 0 && !infinity.empty();
  return value > above && value >= at_least && value < below && value <= at_most;
}

std::string Range::text(const std::string& unit) const {
  std::vector<std::string> bounds;
  if (above > -none) bounds.push_back("> " + number_text(above));
  if (at_least > -none) bounds.push_back(">= " + number_text(at_least));
  if (below < none) bounds.push_back("< " + number_text(below));
  if (at_most < none) bounds.push_back("<= " + number_text(at_most));
  std::string text = "a number";
  if (!bounds.empty()) text += fmt::format(" {}", fmt::join(bounds, " and "));
  if (!unit.empty()) text += ", in " + unit;
  if (!infinity.empty()) text += fmt::format(", or inf ({})", infinity);
  return text;
}

std::string shown(const toml::node& node) {
  if (const std::optional<double> number = as_number(node)) return number_text(*number);
  if (const auto* text = node.as_string()) return fmt::format("'{}'", text->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* array = node.as_array()) return fmt::format("an array of {}", array->size());
  return node.is_table() ? "a table" : "a date or time";
}

Complaint read_number(const toml::node& node, const Range& range, double& value) {
  const std::optional<double> number = as_number(node);
  if (!number) return {"is " + shown(node)};
  if (!range.contains(*number)) return {"is " + shown(node), range.hint};
  value = *number;
  return {};
}

Complaint read_whole_number(const toml::node& node, int lowest, int highest, int& value) {
  const auto* number = node.as_integer();
  if (number == nullptr || number->get() < lowest || number->get() > highest)
    return {"is " + shown(node)};
  value = static_cast<int>(number->get());
  return {};
}

Complaint read_text_value(const toml::node& node, std::string& value) {
  const auto* text = node.as_string();
  if (text == nullptr) return {"is " + shown(node)};
  value = text->get();
  return {};
}

bool is_name(const std::string& text) {
  // Bytes above 127 belong to letters beyond ASCII.
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) > 127;
  };
  const auto is_part = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !text.empty() && (is_letter(text[0]) || text[0] == '_') &&
         std::ranges::all_of(text, is_part);
}

Complaint read_name(const toml::node& node, std::string& value) {
  const auto* text = node.as_string();
  if (text == nullptr || !is_name(text->get())) return {"is " + shown(node)};
  value = text->get();
  return {};
}

Complaint read_word(const toml::node& node, const std::vector<std::string>& names,
                    std::size_t& index) {
  const auto* word = node.as_string();
  if (word == nullptr) return {"is " + shown(node)};
  const auto found = std::ranges::find(names, word->get());
  if (found == names.end()) return {"is " + shown(node), did_you_mean(word->get(), names)};
  index = static_cast<std::size_t>(found - names.begin());
  return {};
}

Complaint read_words(const toml::node& node, const std::vector<std::string>& names,
                     std::vector<std::string>& value) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return {"is " + shown(node)};
  std::vector<std::string> words;
  for (const toml::node& entry : *array) {
    std::size_t index = 0;
    if (const Complaint wrong = read_word(entry, names, index))
      return {"holds " + shown(entry), wrong.hint};
    if (std::ranges::find(words, names[index]) != words.end())
      return {fmt::format("holds '{}' twice", names[index])};
    words.push_back(names[index]);
  }
  value = words;
  return {};
}

Complaint read_vector(const toml::node& node, int dimension, std::array<double, 3>& value) {
  std::vector<double> numbers;
  const auto known = static_cast<std::size_t>(dimension);
  const std::size_t count = dimension != 0 ? known : std::clamp<std::size_t>(size_of(node), 2, 3);
  if (Complaint wrong = read_numbers(node, count, numbers)) return wrong;
  value = {numbers.front(), count == 3 ? numbers[1] : 0.0, numbers.back()};
  return {};
}

Complaint read_gravity(const toml::node& node, int dimension, std::array<double, 3>& value) {
  const bool has_y = dimension == 2 && size_of(node) == 3;
  if (Complaint wrong = read_vector(node, has_y ? 3 : dimension, value)) return wrong;
  if (has_y && value[1] != 0.0) return {"has a y part, which plane strain has not"};
  return {};
}

Complaint read_interval(const toml::node& node, std::array<double, 2>& value) {
  std::vector<double> numbers;
  if (Complaint wrong = read_numbers(node, 2, numbers)) return wrong;
  if (numbers[1] <= numbers[0])
    return {fmt::format("runs from {} to {}", number_text(numbers[0]), number_text(numbers[1]))};
  value = {numbers[0], numbers[1]};
  return {};
}

Complaint read_polygon(const toml::node& node, std::vector<std::array<double, 2>>& value) {
  if (size_of(node) < 3) return {"is " + shown(node)};
  std::vector<std::array<double, 2>> polygon;
  for (const toml::node& entry : *node.as_array()) {
    std::vector<double> corner;
    if (const Complaint wrong = read_numbers(entry, 2, corner))
      return {fmt::format("has a corner {} that {}", polygon.size(), wrong.what)};
    polygon.push_back({corner[0], corner[1]});
  }
  value = std::move(polygon);
  return {};
}

Complaint read_box(const toml::node& node, int dimension, Region& region) {
  if (size_of(node) != 2) return {"is " + shown(node)};
  std::array<std::array<double, 3>, 2> corners{};
  for (std::size_t i = 0; i < 2; ++i)
    if (const Complaint wrong = read_vector((*node.as_array())[i], dimension, corners[i]))
      return {fmt::format("has a corner {} that {}", i, wrong.what)};
  const auto& [low, high] = corners;
  for (const std::size_t axis : {0U, 1U, 2U}) {
    const bool used = axis != 1 || dimension == 3;
    if (used && high[axis] <= low[axis])
      return {fmt::format("is empty: {} runs from {} to {}", "xyz"[axis], number_text(low[axis]),
                          number_text(high[axis]))};
  }
  region.polygon = {{low[0], low[2]}, {high[0], low[2]}, {high[0], high[2]}, {low[0], high[2]}};
  region.depth = {low[1], high[1]};
  return {};
}

Complaint read_wall(const toml::node& node, Wall& value) {
  const toml::table* table = node.as_table();
  if (table != nullptr)
    for (const auto& [key, entry] : *table)
      if (key != "kind" && key != "coefficient")
        return {fmt::format("holds an unknown key '{}'", key.str()),
                did_you_mean(key.str(), {"kind", "coefficient"})};
  const toml::node* kind = table != nullptr ? table->get("kind") : &node;
  if (kind == nullptr) return {"has no 'kind'"};
  std::size_t index = 0;
  if (Complaint wrong = read_word(*kind, wall_words, index)) return wrong;
  Wall wall{.kind = static_cast<WallKind>(index)};

  const toml::node* coefficient = table != nullptr ? table->get("coefficient") : nullptr;
  if (wall.kind == WallKind::friction) {
    if (coefficient == nullptr) return {"is 'friction' without a coefficient"};
    if (read_number(*coefficient, {.at_least = 0}, wall.friction_coefficient))
      return {"has the coefficient " + shown(*coefficient), "it must be a number >= 0"};
  } else if (coefficient != nullptr) {
    return {fmt::format("is {} with a coefficient, which only 'friction' has", shown(*kind))};
  }
  value = wall;
  return {};
}

Complaint read_truth(const toml::node& node, bool& value) {
  const auto* flag = node.as_boolean();
  if (flag == nullptr) return {"is " + shown(node)};
  value = flag->get();
  return {};
}

Complaint read_name_list(const toml::node& node, std::vector<std::string>& value) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return {"is " + shown(node)};
  std::vector<std::string> names;
  for (const toml::node& entry : *array) {
    std::string name;
    if (read_name(entry, name)) return {"holds " + shown(entry)};
    if (std::ranges::find(names, name) != names.end())
      return {fmt::format("holds '{}' twice", name)};
    names.push_back(name);
  }
  value = names;
  return {};
}

Complaint read_names(const toml::node& node, std::map<std::string, std::string>& value) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return {"is " + shown(node)};
  std::map<std::string, std::string> names;
  for (const auto& [key, entry] : *table)
    if (read_name(entry, names[std::string(key.str())]))
      return {fmt::format("has '{}', which is {}", key.str(), shown(entry))};
  value = names;
  return {};
}

Complaint read_ramp(const toml::node& node, Ramp& value) {
  double constant = 0.0;
  if (!read_number(node, {}, constant)) {
    value.points = {{0.0, constant}};
    return {};
  }
  if (size_of(node) == 0) return {"is " + shown(node)};
  std::vector<std::array<double, 2>> points;
  for (const toml::node& entry : *node.as_array()) {
    std::vector<double> pair;
    if (const Complaint wrong = read_numbers(entry, 2, pair))
      return {fmt::format("has a point {} that {}", points.size(), wrong.what)};
    if (pair[0] < 0.0 || (!points.empty() && pair[0] <= points.back()[0]))
      return {fmt::format("has the time {} at point {}", number_text(pair[0]), points.size())};
    points.push_back({pair[0], pair[1]});
  }
  value.points = points;
  return {};
}

nlohmann::ordered_json ramp_json(const Ramp& ramp) {
  if (ramp.constant()) return ramp.points.front()[1];
  return ramp.points;
}

Complaint read_ramps(const toml::node& node, std::map<std::string, Ramp>& value) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return {"is " + shown(node)};
  std::map<std::string, Ramp> ramps;
  for (const auto& [key, entry] : *table)
    if (const Complaint wrong = read_ramp(entry, ramps[std::string(key.str())]))
      return {fmt::format("has '{}', which {}", key.str(), wrong.what)};
  value = ramps;
  return {};
}

} // namespace scarp::io
