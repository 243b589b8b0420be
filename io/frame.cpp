#include "io/frame.hpp"

#include "io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace scarp::io {

bool Frame::has(const std::string& name) const {
  return std::ranges::any_of(columns, [&](const Column& c) { return c.name == name; });
}

const Column& Frame::column(const std::string& name) const {
  const auto found = std::ranges::find(columns, name, &Column::name);
  if (found != columns.end()) return *found;
  std::vector<std::string> names;
  for (const Column& c : columns) names.push_back(c.name);
  throw std::runtime_error(fmt::format("the frame has no field '{}'; it has {}", name,
                                       names.empty() ? "none" : quoted_list(names, "and")));
}

} // namespace scarp::io
