#include "io/snapshot.hpp"

#include "core/error.hpp"
#include "io/frame_file.hpp"
#include "io/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scarp::io {
namespace {

Frame last_frame(const std::filesystem::path& where) {
  if (where.extension() == ".vtp") return read_frame(where);
  const SeriesReader series(where);
  if (series.size() == 0)
    throw std::runtime_error(fmt::format("{}: the series has no frame", where.string()));
  return series.read(series.size() - 1);
}

void check_time(const Scene& scene, std::size_t stage, double time) {
  double begin = 0.0;
  for (std::size_t i = 0; i < stage; ++i) {
    if (scene.stages[i].until_rest) return;
    begin += scene.stages[i].duration;
  }
  if (stage > 0 && std::abs(time - begin) > 1e-9 * begin)
    throw SetupError(fmt::format("stage '{}' begins at {} s, but '{}' ends at {} s",
                                 scene.stages[stage].name, begin, scene.stages[stage].begin_from,
                                 time));
}

} // namespace

Snapshot snapshot_of(const Frame& frame) {
  const auto values = [&](const char* name) { return frame.column(name).values; };
  return {.time = frame.time,
          .steps = frame.step,
          .position = frame.position,
          .displacement = values("displacement"),
          .velocity = values("velocity"),
          .stress = values("stress"),
          .volume = values("volume"),
          .initial_volume = values("initial_volume"),
          .plastic_strain = values("equivalent_plastic_strain"),
          .gap = values("gap"),
          .velocity_gradient = values("velocity_gradient")};
}

std::unique_ptr<Simulation> make_simulation_from_files(const Scene& scene) {
  const auto stage =
      std::ranges::find_if(scene.stages, [](const Stage& s) { return !s.begin_from.empty(); });
  if (stage == scene.stages.end()) return make_simulation(scene);
  const Snapshot start = snapshot_of(last_frame(stage->begin_from));
  check_time(scene, static_cast<std::size_t>(stage - scene.stages.begin()), start.time);
  return make_simulation(scene, &start);
}

} // namespace scarp::io
