// The pictures of a series drawn by several processes side by side.
#pragma once

#include "apps/render_part.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace scarp::apps {

/// Calls `scarp WORDS...`, with `--part=FILE` behind the first word, with each of `jobs` files,
/// which share out the frames. Processes, not threads: Mesa's and VTK's state is one a process.
/// Throws std::runtime_error with the first failure once all have ended, so that the other pictures
/// are there, and, having ended them, when a signal asks this program to end.
void draw_side_by_side(const std::vector<std::string>& words, const RenderPart& whole,
                       std::size_t jobs);

} // namespace scarp::apps
