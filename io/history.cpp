#include "io/history.hpp"

#include "io/text.hpp"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

namespace scarp::io {
namespace {

// Checked before an older file is emptied.
const std::filesystem::path& checked(const std::filesystem::path& path,
                                     const std::vector<std::string>& columns) {
  std::set<std::string> names;
  for (const std::string& name : columns)
    if (name.empty() || name.find_first_of(",#\r\n") != std::string::npos ||
        !names.insert(name).second)
      throw std::runtime_error(
          fmt::format("{}: '{}' is no column name, or is there twice", path.string(), name));
  return path;
}

} // namespace

HistoryWriter::HistoryWriter(const std::filesystem::path& path,
                             const std::vector<std::string>& columns)
    : file_(checked(path, columns)), columns_(columns.size()) {
  file_.write(fmt::format("{}\n", fmt::join(columns, ",")));
}

void HistoryWriter::row(std::span<const double> values) {
  if (values.size() != columns_)
    throw std::runtime_error(fmt::format("{}: {} values for {} columns", file_.path().string(),
                                         values.size(), columns_));
  std::string line;
  for (const double value : values) {
    line += line.empty() ? "" : ",";
    line += number_text(value);
  }
  file_.write(line + "\n");
}

} // namespace scarp::io
