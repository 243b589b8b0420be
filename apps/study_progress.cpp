#include "apps/study_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace scarp::apps {

namespace {

std::string clock_text(double seconds) {
  const long whole = static_cast<long>(seconds);
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

} // namespace

StudyProgress::StudyProgress() : visible_(::isatty(STDERR_FILENO) != 0) {}

StudyProgress::~StudyProgress() { clear(); }

void StudyProgress::show(const StudyState& state) {
  if (!visible_) return;
  const double elapsed = seconds();
  std::string line =
      fmt::format("{}/{} finished, {} running, {} failed, {} elapsed", state.finished,
                  state.scenarios, state.running, state.failed, clock_text(elapsed));
  if (state.part > part_) {
    part_ = state.part;
    total_ = elapsed / part_;
  }
  if (part_ > 0.0)
    line += fmt::format(", about {} left", clock_text(std::max(0.0, total_ - elapsed)));
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  written_ = true;
}

void StudyProgress::say(const std::string& line) {
  clear();
  std::fprintf(stderr, "scarp: %s\n", line.c_str());
}

double StudyProgress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void StudyProgress::clear() {
  if (written_) std::fputs("\r\033[K", stderr);
  written_ = false;
}

} // namespace scarp::apps
