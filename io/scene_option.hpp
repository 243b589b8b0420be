// The pieces that io/scene_sections_*.cpp declare the options of a scene file with.
#pragma once

#include "io/scene_value.hpp"
#include "io/text.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace scarp::io {

using Json = nlohmann::ordered_json;

/// What every option says of itself; T is what the values of its section end up in.
template <typename T> struct Declaration {
  std::string key;
  std::string unit;    ///< empty: none
  std::string allowed; ///< completes "must be ..."
  std::string help;
  std::function<Complaint(const toml::node&, int dimension, T&)> read;
  std::function<Json(const T&, int dimension)> write; ///< null: another option stands for it
};

/// A declaration and when it applies.
template <typename T> struct Option : Declaration<T> {
  explicit(false) Option(Declaration<T> declaration) : Declaration<T>(std::move(declaration)) {}

  bool required = false;
  std::vector<std::string> instead_of; ///< options that this one replaces

  /// When the option exists, as TOML text (`law = "drucker_prager"`), the key that this depends on
  /// (of the same section unless it has a dot) and the condition itself.  Empty: always.
  std::string condition;
  std::string condition_key;
  std::function<bool(const T&, int dimension)> exists;

  T example{}; ///< a T whose value of this option is the default
};

/// A section of the file: the top level (no name), [name] or, where a Scene has a list, [[name]].
template <typename T> struct Section {
  std::string name;
  std::string help;
  std::vector<Option<T>> options;
  bool needed = false; ///< a list must have an entry
};

template <typename T> Option<T> required(Option<T> option) {
  option.required = true;
  return option;
}

// The builders take their arguments by value and move or capture them.
// NOLINTBEGIN(performance-unnecessary-value-param)

// In what follows a `member` is a pointer to member or a function from T& to the member.

template <typename T, typename Member>
Option<T> number(std::string key, std::string unit, Member member, Range range, std::string help) {
  return Declaration<T>{
      .key = std::move(key),
      .unit = unit,
      .allowed = range.text(unit),
      .help = std::move(help),
      .read = [=](const toml::node& node, int,
                  T& section) { return read_number(node, range, std::invoke(member, section)); },
      .write = [=](const T& section, int) -> Json { return std::invoke(member, section); }};
}

template <typename T, typename Member>
Option<T> whole_number(std::string key, Member member, int lowest, int highest, std::string help) {
  return Declaration<T>{
      .key = std::move(key),
      .unit = "",
      .allowed = "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest),
      .help = std::move(help),
      .read =
          [=](const toml::node& node, int, T& section) {
            return read_whole_number(node, lowest, highest, std::invoke(member, section));
          },
      .write = [=](const T& section, int) -> Json { return std::invoke(member, section); }};
}

/// A choice of words, each with the value it stands for.
template <typename T, typename Value, typename Member>
Option<T> word(std::string key, Member member, std::vector<std::pair<std::string, Value>> words,
               std::string help) {
  std::vector<std::string> names;
  names.reserve(words.size());
  for (const auto& entry : words) names.push_back(entry.first);
  return Declaration<T>{.key = std::move(key),
                        .unit = "",
                        .allowed = quoted_list(names, "or"),
                        .help = std::move(help),
                        .read =
                            [=](const toml::node& node, int, T& section) {
                              std::size_t index = 0;
                              Complaint wrong = read_word(node, names, index);
                              if (!wrong) std::invoke(member, section) = words[index].second;
                              return wrong;
                            },
                        .write = [=](const T& section, int) -> Json {
                          for (const auto& [name, value] : words)
                            if (std::invoke(member, section) == value) return name;
                          return nullptr;
                        }};
}

/// A place or direction: [x, z] in plane strain, [x, y, z] in 3-D.
template <typename T, typename Member>
Option<T> vector(std::string key, std::string unit, Member member, std::string help,
                 Complaint (*read)(const toml::node&, int, std::array<double, 3>&) = read_vector) {
  return Declaration<T>{
      .key = std::move(key),
      .unit = unit,
      .allowed = "[x, z] (3-D: [x, y, z]), finite numbers in " + unit,
      .help = std::move(help),
      .read = [=](const toml::node& node, int dimension,
                  T& section) { return read(node, dimension, std::invoke(member, section)); },
      .write = [=](const T& section, int dimension) -> Json {
        const auto& [x, y, z] = std::invoke(member, section);
        return dimension == 3 ? Json{x, y, z} : Json{x, z};
      }};
}

template <typename T> Option<T> name(std::string help) {
  return required<T>(Declaration<T>{
      .key = "name",
      .unit = "",
      .allowed = name_rule,
      .help = std::move(help),
      .read = [](const toml::node& node, int, T& section) { return read_name(node, section.name); },
      .write = [](const T& section, int) -> Json { return section.name; }});
}

template <typename T> Option<T> instead_of(std::vector<std::string> keys, Option<T> option) {
  option.instead_of = std::move(keys);
  return option;
}

template <typename T> Option<T> only_in_3d(Option<T> option) {
  option.condition = "dimension = 3";
  option.condition_key = "grid.dimension";
  option.exists = [](const T&, int dimension) { return dimension == 3; };
  return option;
}

// NOLINTEND(performance-unnecessary-value-param)

} // namespace scarp::io
