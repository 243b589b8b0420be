#include "io/scene_beginning.hpp"

#include "core/run.hpp"
#include "io/scene_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <set>

namespace scarp::io {
namespace {

// A region whose own material no stage uses gets that of the first stage instead.
void keep_used_materials(Scene& scene) {
  std::set<std::string> used;
  for (Region& region : scene.regions) {
    const auto replaced = [&](const Stage& stage) { return stage.material.contains(region.name); };
    if (std::ranges::all_of(scene.stages, replaced))
      region.material = scene.stages.front().material.at(region.name);
    used.insert(region.material);
  }
  for (const Stage& stage : scene.stages)
    for (const auto& entry : stage.material) used.insert(entry.second);
  std::erase_if(scene.materials,
                [&](const Material& material) { return !used.contains(material.name); });
}

} // namespace

std::optional<Scene> beginning_of(const Scene& scene) {
  const auto continues = [](const Stage& stage) { return !stage.begin_from.empty(); };
  if (scene.stages.size() < 2 || std::ranges::any_of(scene.stages, continues)) return std::nullopt;
  Scene cut = scene;
  cut.title = "shared beginning";
  cut.output.fields.clear();
  cut.stages.pop_back();
  keep_used_materials(cut);
  // No frame is due after the end: an interval may not be longer than the run.
  Timing& timing = cut.timing;
  timing.history_interval = history_interval(timing);
  timing.output_interval = std::min(timing.output_interval, end_time(cut));
  return cut;
}

std::string scene_hash(const Scene& scene) {
  // FNV-1a, 64 bits (Fowler, Noll & Vo, draft-eastlake-fnv-17).
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : scene_to_json(scene).dump()) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return fmt::format("{:016x}", hash);
}

} // namespace scarp::io
