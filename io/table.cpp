#include "io/table.hpp"

#include "io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace scarp::io {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos;
       comma = line.find(',', begin)) {
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  cells.push_back(trimmed(line.substr(begin)));
  return cells;
}

void check_names(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (name.empty()) throw std::runtime_error("a column has no name");
    if (std::ranges::count(names, name) > 1)
      throw std::runtime_error(fmt::format("two columns are named '{}'", name));
  }
}

[[noreturn]] void fail(const std::filesystem::path& file, int line, std::string_view what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, what));
}

} // namespace

const std::vector<double>& Table::column(const std::string& name) const {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return columns[static_cast<std::size_t>(found - names.begin())];
  const std::string hint = did_you_mean(name, names);
  throw std::runtime_error(fmt::format("the table has no column '{}'; it has {}{}", name,
                                       names.empty() ? "none" : quoted_list(names, "and"),
                                       hint.empty() ? "" : " (" + hint + ")"));
}

Table read_table(const std::filesystem::path& file) {
  TextTable text = read_text_table(file);
  Table table{.names = std::move(text.names), .columns = {}};
  table.columns.resize(table.names.size());
  for (std::size_t row = 0; row < text.rows.size(); ++row)
    for (std::size_t i = 0; i < table.names.size(); ++i) {
      try {
        table.columns[i].push_back(parse_number(text.rows[row][i]));
      } catch (const std::runtime_error& error) {
        fail(file, text.lines[row], fmt::format("column '{}': {}", table.names[i], error.what()));
      }
    }
  return table;
}

TextTable read_text_table(const std::filesystem::path& file) {
  TextTable table;
  std::istringstream text(read_text(file));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    try {
      std::vector<std::string> cells = cells_of(line);
      if (table.names.empty()) {
        check_names(cells);
        table.names = std::move(cells);
      } else if (cells.size() == table.names.size()) {
        table.rows.push_back(std::move(cells));
        table.lines.push_back(number);
      } else {
        throw std::runtime_error(
            fmt::format("{} values for {} columns", cells.size(), table.names.size()));
      }
    } catch (const std::runtime_error& error) {
      fail(file, number, error.what());
    }
  }
  if (table.names.empty())
    throw std::runtime_error(fmt::format("{}: the table has no header line", file.string()));
  return table;
}

} // namespace scarp::io
