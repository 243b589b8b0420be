#include "io/section_print.hpp"

#include "io/text.hpp"

#include <string_view>

namespace scarp::io {
namespace {

std::string toml_string(const std::string& value) {
  // JSON's escapes are TOML's, but TOML escapes DEL as well.
  std::string text = Json(value).dump();
  for (std::size_t at = text.find('\x7f'); at != std::string::npos; at = text.find('\x7f', at))
    text.replace(at, 1, "\\u007f");
  return text;
}

// Names may have letters that a TOML key has only in quotes.
std::string toml_key(const std::string& key) {
  constexpr std::string_view bare =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  const bool is_bare = !key.empty() && key.find_first_not_of(bare) == std::string::npos;
  return is_bare ? key : toml_string(key);
}

} // namespace

std::string toml_text(const Json& value) {
  if (value.is_string()) return toml_string(value.get<std::string>());
  if (value.is_number_float()) return number_text(value.get<double>());
  std::vector<std::string> entries;
  if (value.is_array()) {
    for (const Json& entry : value) entries.push_back(toml_text(entry));
    return fmt::format("[{}]", fmt::join(entries, ", "));
  }
  if (value.is_object()) {
    for (const auto& [key, entry] : value.items())
      entries.push_back(fmt::format("{} = {}", toml_key(key), toml_text(entry)));
    return fmt::format("{{ {} }}", fmt::join(entries, ", "));
  }
  return value.dump();
}

} // namespace scarp::io
