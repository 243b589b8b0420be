// What a single option cannot say: how the values of a scene fit together.
#pragma once

#include "core/scene.hpp"
#include "io/scene_report.hpp"

namespace scarp::io {

/// Reports every contradiction, leaving out what follows from problems already reported.
void check_scene(const Scene& scene, SceneReport& report);

} // namespace scarp::io
