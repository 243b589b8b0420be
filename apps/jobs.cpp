#include "apps/commands.hpp"

#include <omp.h>

namespace scarp::apps {

CLI::Option* add_jobs(CLI::App& command, int& jobs, const std::string& what) {
  return command.add_option("--jobs", jobs, what + " side by side; default: one a processor")
      ->check(CLI::Range(1, 1024));
}

std::size_t job_count(int jobs) {
  return static_cast<std::size_t>(jobs > 0 ? jobs : omp_get_num_procs());
}

} // namespace scarp::apps
