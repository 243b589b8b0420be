// Small JSON files, such as the record of a run.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace scarp::io {

/// Writes the record, indented, in the order of its keys; an nlohmann::json converts.  Numbers that
/// JSON does not know (NaN, infinity) become null.  Throws std::runtime_error, with an older file
/// as it was.
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& record);

} // namespace scarp::io
