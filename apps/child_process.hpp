// This program once more, as a process of its own.
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace scarp::apps {

/// How a process ended.
struct Ending {
  int exit_code = -1; ///< of one that ended by itself
  int signal = 0;     ///< that ended it
};

/// Why a process failed that wrote to the log: the last thing the program said, or else its exit
/// code or signal.  Empty if it ended well.
std::string failure_of(const Ending& ending, const std::filesystem::path& log);

/// `scarp ARGUMENTS...` with its output in a file.  It ends with the thread that made it, however
/// that ends (PR_SET_PDEATHSIG): the main thread should.
class ChildProcess {
 public:
  /// `variables` (NAME=VALUE) are for its environment unless that has the name already.
  /// Throws std::system_error.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log,
               const std::vector<std::string>& variables = {});
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills it if it has not ended.
  ~ChildProcess();

  /// Whether it has ended; its ending is then known.
  bool has_ended();
  const Ending& ending() const { return ending_; }

 private:
  pid_t id_ = -1; ///< -1: it has ended
  Ending ending_;
};

/// While it lives, signals that ask this program to end do so only through wait().  A signal that
/// the program was started to ignore (nohup) is left alone.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  ~Signals();

  /// Waits until a child has ended, a signal comes or the time is over.  Returns the signal that
  /// asks this program to end, or 0.
  int wait(std::chrono::milliseconds longest) const;

 private:
  sigset_t awaited_;
  sigset_t before_;
};

} // namespace scarp::apps
