// Starts the program and keeps what it says; a scene small enough to run in a moment.
#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace scarp::test {
namespace fs = std::filesystem;

struct Result {
  int exit_code = -1; ///< of a program that ended by itself
  int signal = 0;     ///< that ended it
  std::string out;
  std::string err;
};

/// A running program.  It is killed and waited for if nobody did.
class Program {
 public:
  /// Starts `scarp ARGUMENTS...`, or another program that is found as a shell would, in a
  /// directory, with the project's data and without a terminal.
  Program(const fs::path& directory, const std::vector<std::string>& arguments,
          const std::string& program = SCARP_PROGRAM);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  /// Reads until it has closed its output, then waits for its end.
  Result wait();
  void kill(int signal = SIGKILL) const;

 private:
  pid_t id_ = -1;
  int out_ = -1;
  int err_ = -1;
};

/// Gives each test a directory of its own, which is the program's working directory.
class EndToEnd : public testing::Test {
 protected:
  EndToEnd();

  Result scarp(const std::vector<std::string>& arguments) const {
    return Program(directory_, arguments).wait();
  }
  fs::path operator/(const fs::path& file) const { return directory_ / file; }
  void write_scene(const std::string& text) const;

  fs::path directory_;
};

/// 400 rods let go beside a smooth wall, in cells of 10 mm; 0.1 s in frames of 0.02 s.
extern const char* const small_scene;

std::string content(const fs::path& file);
std::vector<std::string> names_in(const fs::path& directory);
std::vector<std::string> lines_of(const std::string& text);

/// Width and height of a PNG; 0 and 0 if it is none.
struct Size {
  unsigned width = 0;
  unsigned height = 0;
  bool operator==(const Size&) const = default;
};
Size png_size(const fs::path& file);

inline void expect_success(const Result& result) {
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
}

/// One line that starts with the program's name and holds every one of the words.
void expect_complaint(const Result& result, int exit_code, const std::vector<std::string>& words);

} // namespace scarp::test
