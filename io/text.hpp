// Words and numbers as users read and type them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scarp::io {

/// Shortest decimal text that reads back as exactly this number: 0.0025, 700000, 1e-20, inf, nan.
std::string number_text(double value);

/// Without spaces, tabs and carriage returns at either end.
std::string trimmed(std::string_view text);

/// The number that the whole text is.  Throws std::runtime_error.
double parse_number(std::string_view text);

/// The whole file.  Throws std::runtime_error with path and reason.
std::string read_text(const std::filesystem::path& file);

/// 'a', 'b' or 'c' (with `last` = "or").
std::string quoted_list(const std::vector<std::string>& words, std::string_view last);

/// The candidate that was probably meant: the one fewest edits (insert, delete, replace, swap
/// neighbours) away, or the word with a unit suffix; empty if none is near.
std::string closest(std::string_view word, const std::vector<std::string>& candidates);

/// "did you mean 'x'?" or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

} // namespace scarp::io
