// The part of a scene before its last stage, which scenes that differ later have in common.
#pragma once

#include "core/scene.hpp"

#include <optional>
#include <string>

namespace scarp::io {

/// The scene cut off after the stage before the last, in a form that is equal for all scenes with
/// equal runs up to there: materials that no region has in these stages, the title and the choice
/// of fields are left out.  All fields are written, so that a stage can begin from the run.  None
/// for a scene with fewer than two stages, or one that begins from another run itself.
std::optional<Scene> beginning_of(const Scene& scene);

/// 16 hexadecimal digits that are the same for equal scenes, on all machines.
std::string scene_hash(const Scene& scene);

} // namespace scarp::io
