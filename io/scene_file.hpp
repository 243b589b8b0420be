// Scene files: TOML in, Scene out; and a Scene as TOML, JSON or a manual page.
// All of them follow the one set of options in io/scene_sections_*.cpp.
#pragma once

#include "core/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace scarp::io {

/// All that is wrong with a scene, one line a problem; what() has the lines together.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<std::string> problems);
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

/// Reads and checks a scene.  An override is "key=value": a dotted key (grid.cell_size_m,
/// material.0.cohesion_Pa or, by name, material.rods.cohesion_Pa) and a TOML value, where words
/// need no quotes; it drops an option of the file that excludes it (box_m and polygon_m).  Throws
/// SceneError with every problem found, as "file:line:column: key: what is wrong; what is allowed"
/// or "--set key=value: ...".
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// Every option with the value used.  Written to a file it reads back as an equal Scene.
std::string scene_to_toml(const Scene& scene);

/// The same for a run's record, with the same keys; an infinite value is the string "inf".
nlohmann::ordered_json scene_to_json(const Scene& scene);

/// The manual of scene files: every section and option with unit, default, allowed values, meaning.
std::string scene_reference_markdown();

} // namespace scarp::io
