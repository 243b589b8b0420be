// Every section and option of a scene file, once.
#pragma once

#include "core/scene.hpp"
#include "io/scene_option.hpp"

namespace scarp::io {

struct SceneSchema {
  Section<Scene> top;
  Section<Grid> grid;
  Section<Grid> walls;
  Section<Timing> time;
  Section<Method> method;
  Section<Material> material;
  Section<Region> region;
  Section<Gate> gate;
  Section<Stage> stage;
  Section<Monitor> monitor;
  Section<Output> output;
};

const SceneSchema& scene_schema();

/// What a file that gives nothing describes.
Scene default_scene();

/// Calls visit(section, part) for every section with the part of the scene it describes: one value,
/// or a std::vector where the file has a list of tables.  The dimension comes before all that need
/// it.
template <typename AnyScene, typename Visitor>
void for_each_section(AnyScene& scene, Visitor&& visit) {
  const SceneSchema& schema = scene_schema();
  visit(schema.top, scene);
  visit(schema.grid, scene.grid);
  visit(schema.walls, scene.grid);
  visit(schema.time, scene.timing);
  visit(schema.method, scene.method);
  visit(schema.material, scene.materials);
  visit(schema.region, scene.regions);
  visit(schema.gate, scene.gates);
  visit(schema.stage, scene.stages);
  visit(schema.monitor, scene.monitors);
  visit(schema.output, scene.output);
}

/// The options of a section that this one excludes: those that it replaces or that replace it.
std::vector<std::string> excluded_by(const std::string& section, const std::string& key);

} // namespace scarp::io
