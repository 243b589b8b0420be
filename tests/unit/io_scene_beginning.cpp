#include "io/scene_beginning.hpp"
#include "io/scene_file.hpp"

#include "io_files.hpp"

#include <nlohmann/json.hpp>

using namespace scarp;
using namespace scarp::io;
using namespace scarp::test;

namespace {

const fs::path slope = fs::path(SCARP_SOURCE_DIR) / "data" / "scenes" / "wu2017.toml";

Scene beginning(const std::vector<std::string>& overrides) {
  return beginning_of(read_scene(slope, overrides)).value();
}

nlohmann::ordered_json json(const Scene& scene) { return scene_to_json(scene); }

} // namespace

TEST(SceneBeginning, IsTheSceneBeforeItsLastStage) {
  const Scene cut = beginning({});
  ASSERT_EQ(cut.stages.size(), 1U);
  EXPECT_EQ(cut.stages[0].name, "initial_stress");
  EXPECT_EQ(end_time(cut), 3.0);
  ASSERT_EQ(cut.materials.size(), 1U); // the soil is elastic while gravity rises
  for (const Region& region : cut.regions) EXPECT_EQ(region.material, "elastic");
}

TEST(SceneBeginning, IsAScene) {
  for (const std::string interval : {"0.5", "4"}) { // 4 s are longer than the beginning
    const Scene cut = beginning({"time.output_interval_s=" + interval});
    const fs::path file = write_file(fresh_directory() / "cut.toml", scene_to_toml(cut));
    EXPECT_EQ(json(read_scene(file)), json(cut));
  }
}

/// TOML has such a name as a key only in quotes.
TEST(SceneBeginning, IsASceneWhateverTheNames) {
  Scene cut = beginning({});
  cut.regions[1].name = "Böschung";
  cut.stages[0].material = {{"Böschung", "elastic"}};
  cut.output.front_regions = {"Böschung"};
  const fs::path file = write_file(fresh_directory() / "cut.toml", scene_to_toml(cut));
  EXPECT_EQ(json(read_scene(file)), json(cut));
}

TEST(SceneBeginning, IsTheSameWhateverDiffersLater) {
  const Scene cut = beginning({});
  for (const char* later :
       {"material.soil.cohesion_Pa=1", "stage.slide.body_force.surcharge=2", "title=other",
        "stage.slide.duration_s=1", "output.fields=[\"velocity\"]"}) {
    EXPECT_EQ(json(beginning({later})), json(cut)) << later;
    EXPECT_EQ(scene_hash(beginning({later})), scene_hash(cut)) << later;
  }
  for (const char* before :
       {"material.elastic.youngs_modulus_Pa=60e6", "stage.initial_stress.duration_s=2",
        "grid.cell_size_m=0.5", "method.flip=0.9", "time.output_interval_s=1",
        "time.history_interval_s=0.02", "stage.initial_stress.material.slope=soil"})
    EXPECT_NE(scene_hash(beginning({before})), scene_hash(cut)) << before;
}

/// A material stays as long as one region has it in one of the stages.
TEST(SceneBeginning, KeepsMaterialsInUse) {
  const Scene cut = beginning({"stage.initial_stress.material={ slope = 'elastic' }"});
  EXPECT_EQ(cut.materials.size(), 2U);
  EXPECT_EQ(cut.regions[0].material, "soil");
  EXPECT_EQ(cut.regions[1].material, "elastic");
}

/// The hash names folders that other machines look for.
TEST(SceneBeginning, HashIsFixed) {
  Scene scene;
  const std::string hash = scene_hash(scene);
  EXPECT_EQ(hash.size(), 16U);
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
  scene.title = "other";
  EXPECT_NE(scene_hash(scene), hash);
}

TEST(SceneBeginning, NoneOfScenesOfOneStage) {
  EXPECT_FALSE(beginning_of(read_scene(slope.parent_path() / "bui2008.toml")));
  Scene scene = read_scene(slope);
  scene.stages.erase(scene.stages.begin());
  EXPECT_FALSE(beginning_of(scene));
  EXPECT_FALSE(beginning_of(read_scene(slope, {"stage.slide.begin_from=elsewhere"})));
}
