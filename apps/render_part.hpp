// What is drawn of a series and how it fits in with the rest: handed from process to process.
#pragma once

#include "render/field.hpp"
#include "render/geometry.hpp"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace scarp::apps {

/// Frames, and the colours and the view that all pictures of the series share.
struct RenderPart {
  std::vector<std::size_t> frames;
  render::ColourRange range;
  render::Box view; ///< m
};

/// Numbers read back exactly.  Both throw std::runtime_error.
void write_part(const std::filesystem::path& file, const RenderPart& part);
RenderPart read_part(const std::filesystem::path& file);

} // namespace scarp::apps
