#include "apps/commands.hpp"

namespace scarp::apps {

CLI::Option* add_jobs(CLI::App& command, int& jobs, const std::string& what) {
  return command.add_option("--jobs", jobs, what + " side by side; default: one a processor")
      ->check(CLI::Range(1, 1024));
}

} // namespace scarp::apps
