#include "io/table.hpp"

#include "io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>

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

void add_names(Table& table, const std::vector<std::string>& cells) {
  for (const std::string& name : cells) {
    if (name.empty()) throw std::runtime_error("a column has no name");
    if (std::ranges::count(cells, name) > 1)
      throw std::runtime_error(fmt::format("two columns are named '{}'", name));
  }
  table.names = cells;
  table.columns.resize(cells.size());
}

void add_row(Table& table, const std::vector<std::string>& cells) {
  if (cells.size() != table.names.size())
    throw std::runtime_error(
        fmt::format("{} values for {} columns", cells.size(), table.names.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    try {
      table.columns[i].push_back(parse_number(cells[i]));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("column '{}': {}", table.names[i], error.what()));
    }
  }
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
  Table table;
  std::istringstream text(read_text(file));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    try {
      if (table.names.empty())
        add_names(table, cells_of(line));
      else
        add_row(table, cells_of(line));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), number, error.what()));
    }
  }
  if (table.names.empty())
    throw std::runtime_error(fmt::format("{}: the table has no header line", file.string()));
  return table;
}

} // namespace scarp::io
