#include "io/scene_report.hpp"

#include "io/text.hpp"

#include <fmt/format.h>

#include <tuple>

namespace scarp::io {
namespace {

std::string section_of(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

bool is_override(const Origin& origin) { return origin.source.starts_with(override_prefix); }

} // namespace

Origin SceneReport::origin_of(const toml::source_region& source) const {
  return {source.path ? *source.path : file_, source.begin.line, source.begin.column};
}

void SceneReport::place(const std::string& key, const toml::source_region& source) {
  origins_[key] = origin_of(source);
}

void SceneReport::problem(const std::string& key, const std::string& text) {
  std::string placed = key;
  while (!placed.empty() && !origins_.contains(placed)) placed = section_of(placed);
  const auto found = origins_.find(placed);
  add(found == origins_.end() ? Origin{file_, 1, 1} : found->second, key, text);
}

void SceneReport::problem(const std::string& key, const toml::source_region& source,
                          const std::string& text) {
  add(origin_of(source), key, text);
}

void SceneReport::override_problem(const std::string& override_text, const std::string& text) {
  const std::string source = std::string(override_prefix) + override_text;
  problems_.push_back({{source, 0, 0}, fmt::format("{}: {}", source, text)});
}

void SceneReport::add(const Origin& origin, const std::string& key, const std::string& text) {
  bad_.insert(key);
  if (is_override(origin)) {
    std::string set_key = origin.source.substr(override_prefix.size());
    set_key.erase(std::min(set_key.find('='), set_key.size()));
    const bool says_key = last_part(trimmed(set_key)) == last_part(key);
    problems_.push_back(
        {origin, fmt::format("{}: {}{}", origin.source, says_key ? "" : key + ": ", text)});
  } else {
    problems_.push_back({origin, fmt::format("{}:{}:{}: {}: {}", origin.source, origin.line,
                                             origin.column, key, text)});
  }
}

bool SceneReport::usable(const std::vector<std::string>& keys) const {
  for (std::string key : keys)
    for (; !key.empty(); key = section_of(key))
      if (bad_.contains(key)) return false;
  return true;
}

std::vector<std::string> SceneReport::lines() const {
  std::vector<Problem> sorted = problems_;
  std::ranges::stable_sort(sorted, {}, [](const Problem& problem) {
    const bool last = is_override(problem.origin);
    return last ? std::tuple(true, 0U, 0U)
                : std::tuple(false, problem.origin.line, problem.origin.column);
  });
  std::vector<std::string> lines;
  lines.reserve(sorted.size());
  for (const Problem& problem : sorted) lines.push_back(problem.line);
  return lines;
}

} // namespace scarp::io
