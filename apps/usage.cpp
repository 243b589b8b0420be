#include "apps/usage.hpp"

#include <omp.h>

#include <string>
#include <system_error>

namespace scarp::apps {

namespace fs = std::filesystem;

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory))
    throw UsageError("--out " + directory.string() + ": " +
                     (error ? error.message() : std::string("is no directory")));
}

std::size_t job_count(int jobs) {
  return static_cast<std::size_t>(jobs > 0 ? jobs : omp_get_num_procs());
}

} // namespace scarp::apps
