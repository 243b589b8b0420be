#include "apps/data_directory.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace scarp::apps {

namespace fs = std::filesystem;

fs::path data_directory() {
  if (const char* chosen = std::getenv("SCARP_DATA")) {
    if (fs::is_directory(chosen)) return chosen;
    throw std::runtime_error(std::string("SCARP_DATA is no directory: ") + chosen);
  }
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  std::string looked;
  for (const char* place : {"../data", "../share/scarp"}) {
    fs::path candidate = (program.parent_path() / place).lexically_normal();
    if (fs::is_directory(candidate / "scenes", ignored)) return candidate;
    looked += (looked.empty() ? "" : ", ") + candidate.string();
  }
  throw std::runtime_error("the program's data is not in " + looked + "; set SCARP_DATA to it");
}

} // namespace scarp::apps
