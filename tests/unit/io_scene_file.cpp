#include "io/scene_file.hpp"

#include "io_files.hpp"

#include <nlohmann/json.hpp>

#include <limits>
#include <variant>

using namespace scarp;
using namespace scarp::io;
using namespace scarp::test;

namespace {

const fs::path data = fs::path(SCARP_SOURCE_DIR) / "data";

// Every kind of value, none at its default.
constexpr const char* full_3d = R"(
title = "A \"block\"\t\\ on a slope"
gravity_m_s2 = [4.905, 0.5, -8.4957]
[grid]
dimension = 3
cell_size_m = 0.1
lower_m = [-1, 0, 0.3]
upper_m = [2, 1, 1.3]
points_per_cell = 3
[walls]
x_lower = "symmetry"
x_upper = "fixed"
y_lower = { kind = "friction", coefficient = 0.25 }
y_upper = { kind = "symmetry" }
z_lower = { kind = "friction", coefficient = 0.1 }
z_upper = "fixed"
[time]
end_s = 3
output_interval_s = 0.1
cfl = 0.2
max_step_s = 1e-3
rest_energy_fraction = 1e-4
rest_duration_s = 0.05
[method]
scheme = "usl"
flip = 0.99
local_damping = 0.1
[[material]]
name = "rock"
law = "linear_elastic"
density_kg_m3 = 2000
youngs_modulus_Pa = 7e7
poissons_ratio = -0.1
[[material]]
name = "soil"
law = "drucker_prager"
density_kg_m3 = 1900.5
youngs_modulus_Pa = 1e6
poissons_ratio = 0.3
cohesion_Pa = 2e4
friction_angle_deg = 25
dilation_angle_deg = 5
cone = "plane_strain"
tension_cutoff_Pa = 100
[[region]]
name = "slope"
material = "soil"
polygon_m = [[0, 0.3], [1, 0.3], [0.1, 1]]
depth_m = [0.2, 0.8]
velocity_m_s = [1, 2, 3]
[[region]]
name = "block"
material = "rock"
box_m = [[-1, 0, 0.3], [0, 1, 1]]
[[gate]]
name = "front"
axis = "y"
position_m = 0.5
release_time_s = 0.25
[[monitor]]
name = "A"
position_m = [0.1, 0.2, 0.4]
[output]
fields = ["velocity", "stress"]
)";

} // namespace

TEST(SceneFile, ReadsThePileOfBui2008) {
  const Scene scene = read_scene(data / "scenes" / "bui2008.toml");
  EXPECT_EQ(scene.grid.dimension, 2);
  EXPECT_EQ(scene.grid.cell_size, 0.0025);
  EXPECT_EQ(scene.grid.upper, (std::array{0.8, 0.0, 0.15}));
  EXPECT_EQ(scene.grid.points_per_cell, 2);
  EXPECT_EQ(scene.grid.walls[0][0].kind, WallKind::symmetry);
  EXPECT_EQ(scene.grid.walls[0][1].kind, WallKind::free);
  EXPECT_EQ(scene.grid.walls[2][0].kind, WallKind::fixed);
  EXPECT_EQ(scene.gravity, (std::array{0.0, 0.0, -9.81}));
  EXPECT_EQ(scene.timing.end_time, 2.1);
  EXPECT_EQ(scene.timing.rest_energy_fraction, 1e-4);
  EXPECT_EQ(scene.timing.max_time_step, std::numeric_limits<double>::infinity());
  EXPECT_EQ(scene.method.scheme, Scheme::musl);

  ASSERT_EQ(scene.materials.size(), 1U);
  const Material& rods = scene.materials[0];
  EXPECT_EQ(rods.density, 2650.0);
  EXPECT_DOUBLE_EQ(rods.youngs_modulus, 3.0 * 0.7e6 * (1.0 - 2.0 * 0.3));
  const auto& law = std::get<DruckerPrager>(rods.law);
  EXPECT_EQ(law.friction_angle, 19.8);
  EXPECT_EQ(law.cohesion, 0.0);
  EXPECT_EQ(law.cone, Cone::inscribed);
  EXPECT_EQ(law.tension_cutoff, std::numeric_limits<double>::infinity());

  ASSERT_EQ(scene.regions.size(), 1U);
  EXPECT_EQ(scene.regions[0].polygon,
            (std::vector<std::array<double, 2>>{{0, 0}, {0.2, 0}, {0.2, 0.1}, {0, 0.1}}));
}

TEST(SceneFile, PresetIsWhereTheMethodStarts) {
  const std::filesystem::path pile = data / "scenes" / "bui2008.toml";
  EXPECT_EQ(read_scene(pile).method.shape, ShapeFunctions::linear);
  const Method accurate = read_scene(pile, {"method.preset=accurate"}).method;
  EXPECT_EQ(accurate.shape, ShapeFunctions::bspline);
  EXPECT_EQ(accurate.transfer, VelocityTransfer::aflip);
  EXPECT_EQ(accurate.flip, 0.999) << "the file's own keys count";
  const Method changed = read_scene(pile, {"method.shape=gimp", "method.preset=accurate"}).method;
  EXPECT_EQ(changed.shape, ShapeFunctions::gimp) << "in whatever order they stand";
  EXPECT_EQ(changed.transfer, VelocityTransfer::aflip);
}

TEST(SceneFile, StepIsTheMethodsWhereNotGiven) {
  const std::filesystem::path slope = data / "scenes" / "wu2017.toml";
  const auto cfl = [&](const std::vector<std::string>& set) {
    return read_scene(slope, set).timing.cfl;
  };
  EXPECT_EQ(cfl({}), 0.3) << "flip";
  EXPECT_EQ(cfl({"method.preset=accurate"}), 0.7);
  EXPECT_EQ(cfl({"method.preset=accurate", "method.transfer=flip"}), 0.3);
  EXPECT_EQ(cfl({"method.preset=accurate", "time.cfl=0.4"}), 0.4);
}

TEST(SceneFile, ReadsEveryOption) {
  const Scene scene = read_scene(write_file(fresh_directory() / "full.toml", full_3d));
  EXPECT_EQ(scene.title, "A \"block\"\t\\ on a slope");
  EXPECT_EQ(scene.gravity, (std::array{4.905, 0.5, -8.4957}));
  EXPECT_EQ(scene.grid.dimension, 3);
  EXPECT_EQ(scene.grid.lower, (std::array{-1.0, 0.0, 0.3}));
  EXPECT_EQ(scene.grid.points_per_cell, 3);
  EXPECT_EQ(scene.grid.walls[1][0].kind, WallKind::friction);
  EXPECT_EQ(scene.grid.walls[1][0].friction_coefficient, 0.25);
  EXPECT_EQ(scene.grid.walls[1][1].kind, WallKind::symmetry);
  EXPECT_EQ(scene.grid.walls[2][0].friction_coefficient, 0.1);
  EXPECT_EQ(scene.timing.cfl, 0.2);
  EXPECT_EQ(scene.timing.max_time_step, 1e-3);
  EXPECT_EQ(scene.timing.rest_duration, 0.05);
  EXPECT_EQ(scene.method.scheme, Scheme::usl);
  EXPECT_EQ(scene.method.flip, 0.99);
  EXPECT_EQ(scene.method.local_damping, 0.1);
  EXPECT_TRUE(std::holds_alternative<LinearElastic>(scene.materials.at(0).law));
  EXPECT_EQ(scene.materials[0].poissons_ratio, -0.1);
  const auto& soil = std::get<DruckerPrager>(scene.materials.at(1).law);
  EXPECT_EQ(soil.dilation_angle, 5.0);
  EXPECT_EQ(soil.cone, Cone::plane_strain);
  EXPECT_EQ(soil.tension_cutoff, 100.0);
  EXPECT_EQ(scene.regions.at(0).depth, (std::array{0.2, 0.8}));
  EXPECT_EQ(scene.regions[0].velocity, (std::array{1.0, 2.0, 3.0}));
  EXPECT_EQ(scene.regions.at(1).depth, (std::array{0.0, 1.0}));
  EXPECT_EQ(scene.regions[1].material, "rock");
  EXPECT_EQ(scene.gates.at(0).axis, 1);
  EXPECT_EQ(scene.gates[0].position, 0.5);
  EXPECT_EQ(scene.gates[0].release_time, 0.25);
  EXPECT_EQ(scene.monitors.at(0).position, (std::array{0.1, 0.2, 0.4}));
  EXPECT_EQ(scene.output.fields, (std::vector<std::string>{"velocity", "stress"}));
}

TEST(SceneFile, APrintedSceneReadsBackEqual) {
  const fs::path directory = fresh_directory();
  for (const fs::path& file :
       {data / "scenes" / "bui2008.toml", write_file(directory / "full.toml", full_3d)}) {
    const Scene scene = read_scene(file);
    const std::string printed = scene_to_toml(scene);
    const Scene again = read_scene(write_file(directory / "again.toml", printed));
    EXPECT_EQ(scene_to_json(again), scene_to_json(scene));
    EXPECT_EQ(scene_to_toml(again), printed);
  }
}

TEST(SceneFile, JsonHasEveryValueUsed) {
  const nlohmann::ordered_json json = scene_to_json(read_scene(data / "scenes" / "bui2008.toml"));
  EXPECT_EQ(json["gravity_m_s2"], (nlohmann::ordered_json{0.0, -9.81}));
  EXPECT_EQ(json["walls"]["z_lower"], "fixed");
  EXPECT_EQ(json["time"]["cfl"], 0.7);
  EXPECT_EQ(json["time"]["history_interval_s"], 0.0);
  EXPECT_EQ(json["time"]["max_step_s"], "inf");
  EXPECT_EQ(json["material"][0]["tension_cutoff_Pa"], "inf");
  EXPECT_FALSE(json["material"][0].contains("bulk_modulus_Pa"));
  EXPECT_FALSE(json["walls"].contains("y_lower"));
}

TEST(SceneFile, OverridesReplaceValues) {
  const Scene scene = read_scene(
      data / "scenes" / "bui2008.toml",
      {"grid.cell_size_m=0.005", "material.0.friction_angle_deg = 20",
       "material.rods.dilation_angle_deg=1", "walls.x_upper=fixed", "title=A pile, again",
       "walls.z_lower={ kind = \"friction\", coefficient = 0.5 }", "method.scheme=\"usf\"",
       "material.rods.youngs_modulus_Pa=5e5", "region.pile.polygon_m=[[0,0],[0.1,0],[0,0.1]]",
       "output.fields=[\"velocity\"]", "grid.upper_m.1=0.2"});
  EXPECT_EQ(scene.grid.cell_size, 0.005);
  const auto& law = std::get<DruckerPrager>(scene.materials[0].law);
  EXPECT_EQ(law.friction_angle, 20.0);
  EXPECT_EQ(law.dilation_angle, 1.0);
  EXPECT_EQ(scene.grid.walls[0][1].kind, WallKind::fixed);
  EXPECT_EQ(scene.title, "A pile, again");
  EXPECT_EQ(scene.grid.walls[2][0].friction_coefficient, 0.5);
  EXPECT_EQ(scene.method.scheme, Scheme::usf);
  EXPECT_EQ(scene.materials[0].youngs_modulus, 5e5); // the file's bulk modulus is dropped
  EXPECT_EQ(scene.regions[0].polygon.size(), 3U);    // and its box
  EXPECT_EQ(scene.output.fields, std::vector<std::string>{"velocity"});
  EXPECT_EQ(scene.grid.upper[2], 0.2);
}

TEST(SceneFile, ReferenceIsUpToDate) {
  const std::string reference = scene_reference_markdown();
  const fs::path file = data / "scene_reference.md";
  if (reference == content(file)) return;
  const fs::path actual = write_file(fresh_directory() / "scene_reference.md", reference);
  FAIL() << "refresh it: cp " << actual.string() << " " << file.string();
}
