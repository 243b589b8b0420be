// Reads the sections of a TOML file, one after the other, as their declarations say.
#pragma once

#include "io/scene_option.hpp"
#include "io/scene_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace scarp::io {

/// The file's table.  Throws SceneError if it cannot be read or is no TOML.
toml::table parse_toml(const std::filesystem::path& file);

/// "text (hint)", or the text alone.
std::string with_hint(const std::string& text, const std::string& hint);

/// Calling it with a section and the value that the section describes, or a std::vector of these
/// where the file has a list of tables, fills the value in and reports what is wrong.
class SectionReader {
 public:
  /// `sections` are the names that the top level may hold besides its options; the dimension goes
  /// to the options (0: unknown).  File and report have to outlive the reader.
  SectionReader(const toml::table& file, std::vector<std::string> sections, int dimension,
                SceneReport& report)
      : file_(file), sections_(std::move(sections)), dimension_(dimension), report_(report) {}

  template <typename T> void operator()(const Section<T>& section, T& part) {
    if (section.name.empty()) {
      read_options(section, file_, "", sections_, part);
      return;
    }
    const bool needed = std::ranges::any_of(section.options, &Option<T>::required);
    const toml::node* node = file_.get(section.name);
    if (node != nullptr && node->is_table()) {
      report_.place(section.name, node->source());
      read_options(section, *node->as_table(), section.name, {}, part);
    } else if (node != nullptr) {
      report_.place(section.name, node->source());
      report_.problem(section.name, fmt::format("is {}; must be one section, headed [{}]",
                                                shown(*node), section.name));
    } else if (needed) {
      report_.problem(section.name,
                      fmt::format("is missing; must be a section, headed [{}]", section.name));
    }
  }

  template <typename T> void operator()(const Section<T>& section, std::vector<T>& parts) {
    const toml::node* node = file_.get(section.name);
    const toml::array* list = node == nullptr ? nullptr : node->as_array();
    if (node != nullptr) report_.place(section.name, node->source());
    const bool all_tables =
        list != nullptr && std::ranges::all_of(*list, [](const auto& n) { return n.is_table(); });
    if (node != nullptr && !all_tables) {
      report_.problem(section.name,
                      fmt::format("is {}; must be a list of sections, each headed [[{}]]",
                                  shown(*node), section.name));
    } else if (section.needed && (list == nullptr || list->empty())) {
      report_.problem(
          section.name,
          fmt::format("is missing; must be at least one section, headed [[{}]]", section.name));
    } else if (list != nullptr) {
      read_list(section, *list, parts);
    }
  }

 private:
  template <typename T>
  void read_list(const Section<T>& section, const toml::array& list, std::vector<T>& parts) {
    parts.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
      if (const toml::node* name = list[i].as_table()->get("name")) read_name(*name, parts[i].name);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string key = item_key(section.name, parts, i);
      report_.place(key, list[i].source());
      read_options(section, *list[i].as_table(), key, {}, parts[i]);
    }
  }

  template <typename T>
  void read_options(const Section<T>& section, const toml::table& table, const std::string& prefix,
                    std::vector<std::string> allowed, T& part) {
    const auto key_of = [&](const std::string& key) {
      return prefix.empty() || key.find('.') != std::string::npos ? key : prefix + "." + key;
    };
    for (const Option<T>& option : section.options) {
      const std::string key = key_of(option.key);
      const toml::node* node = table.get(option.key);
      if (node != nullptr) report_.place(key, node->source());
      if (option.exists) {
        if (!report_.usable({key_of(option.condition_key)})) continue;
        if (!option.exists(part, dimension_)) {
          if (node != nullptr)
            report_.problem(
                key, fmt::format("is not used here; must be left out unless {}", option.condition));
          continue;
        }
      }
      if (node == nullptr)
        check_missing(section, table, option, key);
      else
        read_option(table, option, *node, key, part);
    }
    for (const Option<T>& option : section.options) allowed.push_back(option.key);
    check_unknown(table, prefix, allowed);
  }

  template <typename T>
  void read_option(const toml::table& table, const Option<T>& option, const toml::node& node,
                   const std::string& key, T& part) {
    for (const std::string& other : option.instead_of)
      if (table.contains(other)) {
        report_.problem(
            key, fmt::format("is given besides '{}'; must be left out, or replace it", other));
        return;
      }
    if (const Complaint wrong = option.read(node, dimension_, part))
      report_.problem(
          key, with_hint(fmt::format("{}; must be {}", wrong.what, option.allowed), wrong.hint));
  }

  template <typename T>
  void check_missing(const Section<T>& section, const toml::table& table, const Option<T>& option,
                     const std::string& key) {
    std::string others;
    for (const Option<T>& other : section.options) {
      if (std::ranges::find(other.instead_of, option.key) == other.instead_of.end()) continue;
      if (table.contains(other.key)) return;
      others += fmt::format("; '{}' may replace it", other.key);
    }
    if (option.required)
      report_.problem(key, fmt::format("is missing; must be {}{}", option.allowed, others));
  }

  void check_unknown(const toml::table& table, const std::string& prefix,
                     const std::vector<std::string>& allowed);

  const toml::table& file_;
  std::vector<std::string> sections_;
  int dimension_;
  SceneReport& report_;
};

} // namespace scarp::io
