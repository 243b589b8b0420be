#include "io/scene_file.hpp"

#include "io/scene_checks.hpp"
#include "io/scene_overrides.hpp"
#include "io/scene_report.hpp"
#include "io/scene_schema.hpp"
#include "io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace scarp::io {
namespace {

std::string with_hint(const std::string& text, const std::string& hint) {
  return hint.empty() ? text : fmt::format("{} ({})", text, hint);
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  const Scene scene;
  for_each_section(scene, [&](const auto& section, const auto&) {
    if (!section.name.empty()) names.push_back(section.name);
  });
  return names;
}

// Reads the sections of a file one after the other into the parts of a scene.
class SectionReader {
 public:
  SectionReader(const toml::table& file, SceneReport& report) : file_(file), report_(report) {
    const toml::node_view<const toml::node> node = file["grid"]["dimension"];
    const std::int64_t dimension = node ? node.value_exact<std::int64_t>().value_or(0) : 2;
    dimension_ = dimension == 2 || dimension == 3 ? static_cast<int>(dimension) : 0;
  }

  template <typename T> void operator()(const Section<T>& section, T& part) {
    if (section.name.empty()) {
      read_options(section, file_, "", section_names(), part);
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
                     const std::vector<std::string>& allowed) {
    for (const auto& [key, value] : table) {
      const std::string name(key.str());
      if (std::ranges::find(allowed, name) != allowed.end()) continue;
      const bool set = value.source().path && value.source().path->starts_with(override_prefix);
      report_.problem(prefix.empty() ? name : fmt::format("{}.{}", prefix, name),
                      set ? value.source() : key.source(),
                      with_hint("is unknown; must be one of " + quoted_list(allowed, "and"),
                                did_you_mean(name, allowed)));
    }
  }

  const toml::table& file_;
  SceneReport& report_;
  int dimension_ = 0; ///< 0: the file's is wrong
};

toml::table parse(const std::string& file) {
  try {
    return toml::parse(read_text(file), file);
  } catch (const toml::parse_error& error) {
    const toml::source_position& at = error.source().begin;
    throw SceneError(
        {fmt::format("{}:{}:{}: {}; must be TOML", file, at.line, at.column, error.description())});
  } catch (const std::runtime_error& error) {
    throw SceneError({error.what()});
  }
}

} // namespace

SceneError::SceneError(std::vector<std::string> problems)
    : std::runtime_error(fmt::format("{}", fmt::join(problems, "\n"))),
      problems_(std::move(problems)) {}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  SceneReport report(file.string());
  toml::table table = parse(file.string());
  for (const std::string& text : overrides) apply_override(table, text, report);

  Scene scene;
  for_each_section(scene, SectionReader(table, report));
  check_scene(scene, report);
  if (std::vector<std::string> problems = report.lines(); !problems.empty())
    throw SceneError(std::move(problems));
  return scene;
}

} // namespace scarp::io
