// Good studies for tests to spoil.
#pragma once

#include "io/study_file.hpp"

#include "io_scene_problems.hpp"

namespace scarp::test {

inline constexpr const char* good_study = R"(title = "good"
scene = "s.toml"
[set]
"method.scheme" = "usf"
"time.end_s" = 2
[[parameter]]
name = "cohesion_kPa"
keys = ["material.soil.cohesion_Pa"]
scale = 1000
[[parameter]]
name = "friction_deg"
keys = ["material.soil.friction_angle_deg"]
[[scenario]]
name = "soft"
cohesion_kPa = 0.5
friction_deg = 20
[[scenario]]
name = "1-hard"
friction_deg = 30
cohesion_kPa = 2
[measure]
toe_x_m = 1.5
thickness_m = 0.5
smoothing_s = 0.25
rest_fraction = 0.01
rest_duration_s = 0.125
loading_start_s = 1
)";

/// Its scenarios stand in t.csv, which the test has to write.
inline constexpr const char* table_study = R"(scene = "s.toml"
[[parameter]]
name = "cohesion_kPa"
keys = ["material.soil.cohesion_Pa"]
scale = 1000
[[parameter]]
name = "friction_deg"
keys = ["material.soil.friction_angle_deg"]
[table]
file = "t.csv"
name_column = "id"
)";

/// A study file with the good scene, s.toml, beside it.
inline fs::path write_study(const std::string& text) {
  const fs::path directory = fresh_directory();
  write_file(directory / "s.toml", good_scene);
  return write_file(directory / "study.toml", text);
}

/// The problems that read_study finds; the directory is left out.
inline std::vector<std::string> problems_of_study(const fs::path& file) {
  std::vector<std::string> problems;
  try {
    io::read_study(file);
  } catch (const io::SceneError& error) {
    problems = error.problems();
  }
  const std::string directory = file.parent_path().string() + "/";
  for (std::string& line : problems)
    for (std::size_t at = 0; (at = line.find(directory)) != std::string::npos;)
      line.erase(at, directory.size());
  return problems;
}

} // namespace scarp::test
