// A study whose runs take a moment: 100 rods are set under gravity and then pulled sideways.
#pragma once

#include "tests/end_to_end/program.hpp"

#include "io/table.hpp"

#include <map>
#include <string>
#include <vector>

namespace scarp::test {

/// `pull` multiplies the body force of the last stage; at 4000 points leave the grid.
inline constexpr const char* staged_scene = R"(title = "A block of rods is pulled"
gravity_m_s2 = [4, -9.81]

[grid]
cell_size_m = 0.01
lower_m = [0, 0]
upper_m = [0.2, 0.1]

[walls]
z_lower = "fixed"

[time]
output_interval_s = 0.02
history_interval_s = 0.001

[[material]]
name = "firm"
law = "linear_elastic"
density_kg_m3 = 2650
youngs_modulus_Pa = 0.84e6
poissons_ratio = 0.3

[[material]]
name = "rods"
law = "drucker_prager"
density_kg_m3 = 2650
youngs_modulus_Pa = 0.84e6
poissons_ratio = 0.3
cohesion_Pa = 0
friction_angle_deg = 19.8

[[region]]
name = "block"
material = "rods"
box_m = [[0.05, 0], [0.1, 0.05]]

[[stage]]
name = "rise"
duration_s = 0.02
gravity = [[0, 0], [0.02, 1]]
material = { block = "firm" }

[[stage]]
name = "slide"
duration_s = 0.04

[[monitor]]
name = "top"
position_m = [0.1, 0.05]
)";

inline constexpr const char* small_study = R"(scene = "scene.toml"
[set]
"method.flip" = 0.99
[[parameter]]
name = "friction_deg"
keys = ["material.rods.friction_angle_deg"]
[[parameter]]
name = "pull"
keys = ["stage.slide.body_force.block"]
divide_by = 2
[[scenario]]
name = "a"
friction_deg = 20
pull = 2
[[scenario]]
name = "b"
friction_deg = 30
pull = 2
[[scenario]]
name = "c"
friction_deg = 20
pull = 3
[measure]
toe_x_m = 0.08
thickness_m = 0.5
smoothing_s = 0.005
loading_start_s = 0.02
)";

class StudyTest : public EndToEnd {
 protected:
  StudyTest() {
    write("scene.toml", staged_scene);
    write("study.toml", small_study);
  }

  void write(const std::string& file, const std::string& text) const;
  /// The study with a part of its text replaced.
  void change_study(const std::string& old_text, const std::string& new_text) const;

  /// `scarp study study.toml --out out --jobs 2 MORE...`
  std::vector<std::string> study_words(const std::vector<std::string>& more = {}) const;
  Result study(const std::vector<std::string>& more = {}) const { return scarp(study_words(more)); }

  /// When the files of a directory, and of those in it, were last written.
  std::map<std::string, fs::file_time_type> times(const fs::path& directory) const;
};

/// results.csv, row by row: the scenario's name and the values by column.
std::map<std::string, std::map<std::string, double>> results_in(const fs::path& directory);

/// Waits until the file is there; fails after a minute.
void await(const fs::path& file);

/// The ids of processes that were given a word with this text.
std::vector<std::string> processes_with(const std::string& text);

/// Waits until there are none, at most a moment.
void expect_no_processes_with(const std::string& text);

} // namespace scarp::test
