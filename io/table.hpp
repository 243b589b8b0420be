// Comma-separated tables: '#' comments, one header line, numbers or words.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scarp::io {

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns; ///< columns[i] belongs to names[i]

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// Throws std::runtime_error that names the columns there are.
  const std::vector<double>& column(const std::string& name) const;
};

/// Throws std::runtime_error with file and line.
Table read_table(const std::filesystem::path& file);

/// A table whose cells are as they are written: some columns are words.
struct TextTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows; ///< rows[i][j] belongs to names[j]
  std::vector<int> lines;                     ///< of the rows in the file, from 1
};

/// Throws std::runtime_error with file and line.
TextTable read_text_table(const std::filesystem::path& file);

} // namespace scarp::io
