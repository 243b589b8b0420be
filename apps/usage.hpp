// What the commands ask of their users, without the library that reads the command line: that takes
// seconds to compile.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>

namespace scarp::apps {

/// What the user asked for cannot be done as asked: exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Makes a directory for results; throws UsageError if something else has that name.
void make_directory(const std::filesystem::path& directory);

/// As many side by side as were asked for; 0: as many as there are processors for this program.
std::size_t job_count(int jobs);

} // namespace scarp::apps
