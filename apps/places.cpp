#include "apps/commands.hpp"

namespace scarp::apps {

namespace fs = std::filesystem;

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory))
    throw UsageError("--out " + directory.string() + ": " +
                     (error ? error.message() : std::string("is no directory")));
}

} // namespace scarp::apps
