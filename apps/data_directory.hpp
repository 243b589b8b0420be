// Where the files of `data` are while the program runs.
#pragma once

#include <filesystem>

namespace scarp::apps {

/// The scenes and references that belong to the program: $SCARP_DATA, or `data` beside the build
/// folder, or share/scarp beside the installed program.  Throws std::runtime_error with where it
/// looked.
std::filesystem::path data_directory();

} // namespace scarp::apps
