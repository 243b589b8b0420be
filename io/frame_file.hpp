// One frame as a VTK PolyData file (.vtp): a vertex per point, all columns as point data.
#pragma once

#include "io/frame.hpp"

#include <filesystem>
#include <string>

namespace scarp::io {

/// The bytes of the .vtp file: zlib-compressed inline binary data, doubles, with TimeValue, Step,
/// Dimension, CellSize, Lower and Upper as field data.  Throws std::runtime_error if the columns do
/// not fit the number of points.
std::string encode_frame(const Frame& frame);

/// Throws one std::runtime_error that names the file and says what is wrong with it.
Frame read_frame(const std::filesystem::path& file);

} // namespace scarp::io
