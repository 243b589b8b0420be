// A good scene for tests to spoil.
#pragma once

#include "io/scene_file.hpp"

#include "io_files.hpp"

namespace scarp::test {

/// A good scene; tests replace parts of it.
inline constexpr const char* good_scene = R"(title = "good"
gravity_m_s2 = [0, -9.81]
[grid]
cell_size_m = 0.1
lower_m = [0, 0]
upper_m = [2, 1]
[walls]
z_lower = "fixed"
[time]
end_s = 1
output_interval_s = 0.5
[method]
scheme = "musl"
[[material]]
name = "soil"
law = "drucker_prager"
density_kg_m3 = 2000
poissons_ratio = 0.3
youngs_modulus_Pa = 1e6
cohesion_Pa = 100
friction_angle_deg = 25
[[material]]
name = "rock"
law = "linear_elastic"
density_kg_m3 = 2000
poissons_ratio = 0.3
youngs_modulus_Pa = 1e6
[[region]]
name = "pile"
material = "soil"
polygon_m = [[0, 0], [1, 0], [0, 1]]
[[gate]]
name = "door"
position_m = 1
release_time_s = 0.1
[[monitor]]
name = "A"
position_m = [0.5, 0.5]
[output]
fields = ["velocity"]
)";

/// The problems that read_scene finds in the text; the name of the file is left out.
inline std::vector<std::string> problems_of(const std::string& text,
                                            const std::vector<std::string>& overrides = {}) {
  const fs::path file = write_file(fresh_directory() / "s.toml", text);
  std::vector<std::string> problems;
  try {
    io::read_scene(file, overrides);
  } catch (const io::SceneError& error) {
    problems = error.problems();
  }
  for (std::string& line : problems)
    if (line.starts_with(file.string())) line.erase(0, file.string().size() + 1);
  return problems;
}

} // namespace scarp::test
