// Overrides from the command line: single values of a scene file replaced before it is read.
#pragma once

#include "io/scene_report.hpp"

#include <toml++/toml.h>

#include <string>

namespace scarp::io {

/// Sets the value that "key=value" names in the file's table; see read_scene.  The new value's
/// source path is the override, so that what is wrong with it is reported there.  Options that
/// exclude the one that is set (box_m and polygon_m) are dropped.
void apply_override(toml::table& file, const std::string& override_text, SceneReport& report);

} // namespace scarp::io
