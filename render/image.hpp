// A picture as plain bytes, and PNG files of it.
#pragma once

#include <filesystem>
#include <vector>

namespace scarp::render {

/// 8-bit RGB, rows from the top, three bytes a pixel.
struct Image {
  int width = 0;  ///< px
  int height = 0; ///< px
  std::vector<unsigned char> rgb;

  bool operator==(const Image&) const = default;
};

/// Writes a temporary file beside `file` and renames it, so a reader never sees half a picture.
/// Throws std::runtime_error that names the file; std::invalid_argument if the bytes do not fit the
/// size.
void write_png(const std::filesystem::path& file, const Image& image);

/// An alpha channel is dropped, grey is spread to RGB.  Throws std::runtime_error that names the
/// file.
Image read_png(const std::filesystem::path& file);

} // namespace scarp::render
