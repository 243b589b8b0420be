#include "io/scene_overrides.hpp"

#include "io/scene_schema.hpp"
#include "io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <stdexcept>

namespace scarp::io {
namespace {

// `value = TEXT` with the override as its source; words and paths may lack their quotes.
toml::table parse_value(const std::string& text, const std::string& source) {
  try {
    toml::table parsed = toml::parse("value = " + text, source);
    if (parsed.size() != 1) throw std::runtime_error("holds more than one value");
    return parsed;
  } catch (const toml::parse_error& error) {
    const bool words =
        !text.empty() &&
        (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text.starts_with('/') ||
         text.starts_with("./") || text.starts_with("../")) &&
        text.find_first_of("'\"\n\r[]{}=") == std::string::npos;
    if (words) return toml::parse("value = '" + text + "'", source);
    throw std::runtime_error(fmt::format("'{}' is no TOML value: {}", text, error.description()));
  }
}

std::vector<std::string> split_key(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  if (std::ranges::any_of(parts, &std::string::empty))
    throw std::runtime_error("is not of the form key=value, such as grid.cell_size_m=0.01");
  return parts;
}

// The entry of an array by its index or, in a list of tables, by its name.
std::size_t find_entry(const toml::array& array, const std::string& entry, std::string_view list) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), index);
  if (error == std::errc() && end == entry.data() + entry.size()) {
    if (index < array.size()) return index;
    throw std::runtime_error(
        fmt::format("'{}' has no entry {}; it has {}, counted from 0", list, entry, array.size()));
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const toml::table* table = array[i].as_table();
    names.push_back(table == nullptr ? "" : (*table)["name"].value_or(""));
    if (names.back() == entry) return i;
  }
  std::erase(names, "");
  const std::string hint = did_you_mean(entry, names);
  throw std::runtime_error(fmt::format("'{}' has no entry named '{}'; it has {}{}", list, entry,
                                       names.empty() ? "no names" : quoted_list(names, "and"),
                                       hint.empty() ? "" : " (" + hint + ")"));
}

toml::node& step_into(toml::node& node, const std::string& part, std::string_view path,
                      const std::string& source) {
  if (toml::array* array = node.as_array()) return (*array)[find_entry(*array, part, path)];
  toml::table* table = node.as_table();
  if (table == nullptr) throw std::runtime_error(fmt::format("'{}' is not a section", path));
  if (!table->contains(part)) {
    toml::table empty = parse_value("{}", source);
    table->insert(part, std::move(*empty["value"].as_table()));
  }
  return *table->get(part);
}

void assign(toml::node& node, const std::string& part, std::string_view path, toml::node&& value) {
  std::move(value).visit([&](auto&& concrete) {
    if (toml::table* table = node.as_table()) {
      table->insert_or_assign(part, std::forward<decltype(concrete)>(concrete));
    } else if (toml::array* array = node.as_array()) {
      const auto offset = static_cast<std::ptrdiff_t>(find_entry(*array, part, path));
      array->replace(array->cbegin() + offset, std::forward<decltype(concrete)>(concrete));
    } else {
      throw std::runtime_error(fmt::format("'{}' is not a section", path));
    }
  });
}

} // namespace

void apply_override(toml::table& file, const std::string& override_text, SceneReport& report) {
  try {
    const std::size_t equals = std::min(override_text.find('='), override_text.size());
    const std::vector<std::string> parts = split_key(trimmed(override_text.substr(0, equals)));
    if (equals == override_text.size())
      throw std::runtime_error("is not of the form key=value, such as grid.cell_size_m=0.01");
    const std::string source = std::string(override_prefix) + override_text;
    toml::table value = parse_value(override_text.substr(equals + 1), source);

    toml::node* place = &file;
    std::string path;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      place = &step_into(*place, parts[i], path, source);
      path += (path.empty() ? "" : ".") + parts[i];
    }
    if (toml::table* table = place->as_table())
      for (const std::string& excluded : excluded_by(parts.front(), parts.back()))
        table->erase(excluded);
    assign(*place, parts.back(), path, std::move(*value.get("value")));
  } catch (const std::runtime_error& error) {
    report.override_problem(override_text, error.what());
  }
}

} // namespace scarp::io
