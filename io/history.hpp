// A table that grows by a row at a time while a run goes on; io/table.hpp reads it.
#pragma once

#include "io/file_descriptor.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace scarp::io {

/// Writes comma-separated values.  Each row goes to the file at once and whole, so a killed run
/// leaves full lines; numbers read back exactly.
class HistoryWriter {
 public:
  /// Replaces an older file and writes the header.  Column names carry their unit
  /// (kinetic_energy_J).  Throws std::runtime_error.
  HistoryWriter(const std::filesystem::path& path, const std::vector<std::string>& columns);

  /// One value a column.  Throws std::runtime_error (a full disk says so); the rows before stay.
  void row(std::span<const double> values);

 private:
  FileDescriptor file_;
  std::size_t columns_;
};

} // namespace scarp::io
