// Where each value of a scene came from, and what is wrong with it.
#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace scarp::io {

/// A place in the scene file, or the override ("--set key=value") that set a value.
struct Origin {
  std::string source;
  unsigned line = 0;
  unsigned column = 0;
};

/// What an override's values carry as their source path.
inline constexpr std::string_view override_prefix = "--set ";

/// Collects the problems of one scene.  Keys are dotted: grid.cell_size_m, material.rods.law.
class SceneReport {
 public:
  explicit SceneReport(std::string file) : file_(std::move(file)) {}

  /// Remembers where the value of a key stands.
  void place(const std::string& key, const toml::source_region& source);
  /// The scene file or an override gives the key a value.
  bool placed(const std::string& key) const { return origins_.contains(key); }
  /// A problem at the key's place, or that of the section around it.  `text` is "what is wrong;
  /// what is allowed".
  void problem(const std::string& key, const std::string& text);
  /// A problem at a place that is no value's: an unknown key.
  void problem(const std::string& key, const toml::source_region& source, const std::string& text);
  /// An override that cannot be applied.
  void override_problem(const std::string& override_text, const std::string& text);

  /// No problem was found in any of these keys or in a section around them: a check that relates
  /// them would not report a mere consequence.
  bool usable(const std::vector<std::string>& keys) const;

  /// All problems, by their place in the file and then the overrides.
  std::vector<std::string> lines() const;

 private:
  struct Problem {
    Origin origin;
    std::string line;
  };
  Origin origin_of(const toml::source_region& source) const;
  void add(const Origin& origin, const std::string& key, const std::string& text);

  std::string file_;
  std::map<std::string, Origin> origins_;
  std::set<std::string> bad_;
  std::vector<Problem> problems_;
};

/// The key of an entry of a list of tables: by its name, or by its index if the name is no help.
template <typename Item>
std::string item_key(const std::string& section, const std::vector<Item>& items,
                     std::size_t index) {
  const std::string& name = items[index].name;
  const auto first = std::ranges::find(items, name, &Item::name);
  const bool by_name = !name.empty() && first - items.begin() == static_cast<long>(index);
  return section + "." + (by_name ? name : std::to_string(index));
}

} // namespace scarp::io
