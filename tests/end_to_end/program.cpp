#include "tests/end_to_end/program.hpp"

#include "tests/support/fresh_directory.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace scarp::test {

const char* const small_scene = R"(title = "A block of rods is let go"

[grid]
cell_size_m = 0.01
lower_m = [0, 0]
upper_m = [0.3, 0.15]

[walls]
x_lower = "symmetry"
z_lower = "fixed"

[time]
end_s = 0.1
output_interval_s = 0.02

[[material]]
name = "rods"
law = "drucker_prager"
density_kg_m3 = 2650
youngs_modulus_Pa = 0.84e6
poissons_ratio = 0.3
cohesion_Pa = 0
friction_angle_deg = 19.8

[[region]]
name = "block"
material = "rods"
box_m = [[0, 0], [0.1, 0.1]]
)";

namespace {

void check(int error, const char* what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

struct Pipe {
  std::array<int, 2> ends = {-1, -1};
  Pipe() { check(::pipe2(ends.data(), O_CLOEXEC) == 0 ? 0 : errno, "pipe2"); }
};

/// The test's environment with the project's data and quiet threads.
std::vector<std::string> child_environment() {
  std::vector<std::string> variables = {std::string("SCARP_DATA=") + SCARP_DATA_DIR,
                                        "OMP_WAIT_POLICY=passive"};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view variable = *entry;
    if (!variable.starts_with("SCARP_DATA=") && !variable.starts_with("OMP_"))
      variables.emplace_back(variable);
  }
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

} // namespace

Program::Program(const fs::path& directory, const std::vector<std::string>& arguments,
                 const std::string& program) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = child_environment();

  const Pipe out;
  const Pipe err;
  posix_spawn_file_actions_t actions;
  check(::posix_spawn_file_actions_init(&actions), "posix_spawn_file_actions_init");
  ::posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, out.ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, err.ends[1], STDERR_FILENO);
  const int error = ::posix_spawnp(&id_, program.c_str(), &actions, nullptr, pointers(words).data(),
                                   pointers(environment).data());
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(out.ends[1]);
  ::close(err.ends[1]);
  out_ = out.ends[0];
  err_ = err.ends[0];
  check(error, program.c_str());
}

Program::~Program() {
  if (id_ > 0) {
    kill();
    ::waitpid(id_, nullptr, 0);
  }
  ::close(out_);
  ::close(err_);
}

void Program::kill(int signal) const { ::kill(id_, signal); }

Result Program::wait() {
  Result result;
  std::array<pollfd, 2> streams = {{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
  const std::array<std::string*, 2> texts = {&result.out, &result.err};
  // Both at once: a program that fills one pipe while the other is read would wait for ever.
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (::poll(streams.data(), streams.size(), -1) < 0 && errno != EINTR) check(errno, "poll");
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (streams[i].fd < 0 || streams[i].revents == 0) continue;
      std::array<char, 4096> buffer;
      const ssize_t size = ::read(streams[i].fd, buffer.data(), buffer.size());
      if (size > 0)
        texts[i]->append(buffer.data(), static_cast<std::size_t>(size));
      else
        streams[i].fd = -1; // poll passes it over
    }
  }
  int status = 0;
  check(::waitpid(id_, &status, 0) == id_ ? 0 : errno, "waitpid");
  id_ = -1;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

EndToEnd::EndToEnd() : directory_(fresh_directory()) { write_scene(small_scene); }

void EndToEnd::write_scene(const std::string& text) const {
  std::ofstream(directory_ / "block.toml") << text;
}

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<std::string> names_in(const fs::path& directory) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

Size png_size(const fs::path& file) {
  // Signature, length and name of the first chunk, then width and height, highest byte first.
  const std::string bytes = content(file);
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.size() < 24) return {};
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {number(16), number(20)};
}

void expect_complaint(const Result& result, int exit_code, const std::vector<std::string>& words) {
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_code, exit_code);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_TRUE(result.err.starts_with("scarp: ")) << result.err;
  for (const std::string& word : words)
    EXPECT_NE(result.err.find(word), std::string::npos)
        << "'" << word << "' is not in: " << result.err;
}

} // namespace scarp::test
