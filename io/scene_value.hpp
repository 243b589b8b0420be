// Values of a scene file: from TOML to the types of core/scene.hpp, with what is wrong in words.
#pragma once

#include "core/scene.hpp"

#include <nlohmann/json_fwd.hpp>
#include <toml++/toml.h>

#include <array>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace scarp::io {

/// What is wrong with a value ("is -1") and a hint ("did you mean 'x'?"); nothing: all is well.
struct Complaint {
  std::string what;
  std::string hint = {};
  explicit operator bool() const { return !what.empty(); }
};

/// Which numbers are allowed.  Infinity only where it has a meaning, NaN never.
struct Range {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double above = -none;
  double at_least = -none;
  double below = none;
  double at_most = none;
  std::string infinity = {}; ///< what `inf` means; empty: not allowed
  std::string hint = {};     ///< for a value out of range

  bool contains(double value) const;
  /// "a number > 0 and <= 1, in m"
  std::string text(const std::string& unit) const;
};

/// A value as an error message shows it: 'word', -1, an array of 3, a table.
std::string shown(const toml::node& node);

Complaint read_number(const toml::node& node, const Range& range, double& value);
Complaint read_whole_number(const toml::node& node, int lowest, int highest, int& value);
Complaint read_text_value(const toml::node& node, std::string& value);

/// Names appear in keys, file names and column headings: letters, digits, _ and -, no digit first.
bool is_name(const std::string& text);
inline constexpr const char* name_rule = "a word of letters, digits, '_' and '-', no digit first";
Complaint read_name(const toml::node& node, std::string& value);

/// One of `names`, which gets its index.
Complaint read_word(const toml::node& node, const std::vector<std::string>& names,
                    std::size_t& index);
/// A list of different words out of `names`.
Complaint read_words(const toml::node& node, const std::vector<std::string>& names,
                     std::vector<std::string>& value);

/// [x, z] if the dimension is 2, [x, y, z] if it is 3, either if it is 0 (unknown).
Complaint read_vector(const toml::node& node, int dimension, std::array<double, 3>& value);
/// As read_vector; in plane strain [x, 0, z] as well.
Complaint read_gravity(const toml::node& node, int dimension, std::array<double, 3>& value);
/// [low, high], low below high.
Complaint read_interval(const toml::node& node, std::array<double, 2>& value);
/// [[x, z], [x, z], [x, z], ...]
Complaint read_polygon(const toml::node& node, std::vector<std::array<double, 2>>& value);
/// Two opposite corners, the lower one first; sets the polygon and, in 3-D, the depth.
Complaint read_box(const toml::node& node, int dimension, Region& region);

Complaint read_truth(const toml::node& node, bool& value);
/// Different names.
Complaint read_name_list(const toml::node& node, std::vector<std::string>& value);
/// { NAME = 'NAME', ... }
Complaint read_names(const toml::node& node, std::map<std::string, std::string>& value);

inline constexpr const char* ramp_rule =
    "a finite number, or [[TIME in s, number], ...] with ascending times >= 0, linear in between";
Complaint read_ramp(const toml::node& node, Ramp& value);
nlohmann::ordered_json ramp_json(const Ramp& ramp);
/// { NAME = RAMP, ... }
Complaint read_ramps(const toml::node& node, std::map<std::string, Ramp>& value);

/// The words for walls, in the order of WallKind.
inline const std::vector<std::string> wall_words = {"fixed", "symmetry", "free", "friction"};
/// A word, or { kind = "friction", coefficient = 0.3 }.
Complaint read_wall(const toml::node& node, Wall& value);

} // namespace scarp::io
