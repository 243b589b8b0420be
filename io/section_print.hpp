// Options as TOML text and as pages of a manual.
#pragma once

#include "io/scene_option.hpp"

#include <fmt/format.h>

#include <string>

namespace scarp::io {

/// A value as TOML on one line.  Infinite numbers are inf; null is not allowed.
std::string toml_text(const Json& value);

/// The option's default, or that it is required, as the manual says it.
template <typename T> std::string default_text(const Section<T>& section, const Option<T>& option) {
  std::string text = "required";
  if (!option.required) {
    const Json value = option.write(option.example, 2);
    text = value.is_null() ? "-" : fmt::format("`{}`", toml_text(value));
  }
  for (const Option<T>& other : section.options)
    for (const std::string& replaced : other.instead_of)
      if (replaced == option.key) text += fmt::format(", or `{}`", other.key);
  return text;
}

/// A section of the manual, in Markdown.
template <typename T>
std::string reference_of(const Section<T>& section, const std::string& header) {
  std::string text = fmt::format("\n## {}\n\n{}\n\n", header, section.help);
  text += "| key | unit | default | must be | meaning |\n|---|---|---|---|---|\n";
  for (const Option<T>& option : section.options) {
    std::string meaning = option.help;
    if (!option.condition.empty()) meaning += fmt::format(" Only with `{}`.", option.condition);
    if (!option.instead_of.empty())
      meaning += fmt::format(" Replaces `{}`.", fmt::join(option.instead_of, "` and `"));
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", option.key,
                        option.unit.empty() ? "-" : option.unit, default_text(section, option),
                        option.allowed, meaning);
  }
  return text;
}

} // namespace scarp::io
