#include "io/section_reader.hpp"

#include "io/scene_file.hpp"
#include "io/text.hpp"

#include <stdexcept>

namespace scarp::io {

toml::table parse_toml(const std::filesystem::path& file) {
  try {
    return toml::parse(read_text(file), file.string());
  } catch (const toml::parse_error& error) {
    const toml::source_position& at = error.source().begin;
    throw SceneError({fmt::format("{}:{}:{}: {}; must be TOML", file.string(), at.line, at.column,
                                  error.description())});
  } catch (const std::runtime_error& error) {
    throw SceneError({error.what()});
  }
}

std::string with_hint(const std::string& text, const std::string& hint) {
  return hint.empty() ? text : fmt::format("{} ({})", text, hint);
}

void SectionReader::check_unknown(const toml::table& table, const std::string& prefix,
                                  const std::vector<std::string>& allowed) {
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    if (std::ranges::find(allowed, name) != allowed.end()) continue;
    const bool set = value.source().path && value.source().path->starts_with(override_prefix);
    report_.problem(prefix.empty() ? name : fmt::format("{}.{}", prefix, name),
                    set ? value.source() : key.source(),
                    with_hint("is unknown; must be one of " + quoted_list(allowed, "and"),
                              did_you_mean(name, allowed)));
  }
}

} // namespace scarp::io
