// One line that tells how far a study is.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace scarp::apps {

struct StudyState {
  std::size_t scenarios = 0;
  std::size_t finished = 0;
  std::size_t failed = 0;
  std::size_t running = 0;
  double part = 0.0; ///< of the work of this call, done
};

/// Writes to stderr; the line only if that is a terminal.
class StudyProgress {
 public:
  StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;
  ~StudyProgress();

  void show(const StudyState& state);
  /// A line of its own, which stays.
  void say(const std::string& line);
  double seconds() const; ///< s, since it was made
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  bool written_ = false;
  double part_ = 0.0;  ///< when a run last ended
  double total_ = 0.0; ///< s, that all will take, as it looked then
  Clock::time_point start_ = Clock::now();
};

} // namespace scarp::apps
