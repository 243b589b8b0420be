#include "apps/render_jobs.hpp"

#include "apps/child_process.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <list>
#include <stdexcept>
#include <system_error>

namespace scarp::apps {

namespace fs = std::filesystem;

namespace {

/// For files between processes; it goes with what is in it.
class ScratchDirectory {
 public:
  ScratchDirectory() {
    std::string name = (fs::temp_directory_path() / "scarp_render_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::system_error(errno, std::generic_category(), name);
    path_ = name;
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  ~ScratchDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

struct Drawer {
  Drawer(const std::vector<std::string>& arguments, const fs::path& its_log)
      // Mesa would otherwise start a thread a processor in each of the processes.
      : log(its_log), process(arguments, its_log, {"LP_NUM_THREADS=0"}) {}

  fs::path log;
  ChildProcess process;
};

} // namespace

void draw_side_by_side(const std::vector<std::string>& words, const RenderPart& whole,
                       std::size_t jobs) {
  const Signals signals;
  const ScratchDirectory scratch;
  std::list<Drawer> drawers;
  for (std::size_t job = 0; job < jobs; ++job) {
    // Every jobs-th frame: what a frame costs changes slowly over the series.
    RenderPart part = whole;
    part.frames.clear();
    for (std::size_t i = job; i < whole.frames.size(); i += jobs)
      part.frames.push_back(whole.frames[i]);
    const fs::path file = scratch / fmt::format("part{}.json", job);
    write_part(file, part);
    std::vector<std::string> arguments = words;
    arguments.insert(arguments.begin() + 1, "--part=" + file.string()); // after the command's name
    drawers.emplace_back(arguments, scratch / fmt::format("log{}.txt", job));
  }
  std::string failure;
  while (!drawers.empty()) {
    const int signal = signals.wait(std::chrono::milliseconds(250));
    if (signal != 0) throw std::runtime_error(fmt::format("stopped ({})", ::strsignal(signal)));
    std::erase_if(drawers, [&](Drawer& drawer) {
      if (!drawer.process.has_ended()) return false;
      if (failure.empty()) failure = failure_of(drawer.process.ending(), drawer.log);
      return true;
    });
  }
  if (!failure.empty()) throw std::runtime_error(failure);
}

} // namespace scarp::apps
