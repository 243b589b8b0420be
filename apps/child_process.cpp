#include "apps/child_process.hpp"

#include "io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace scarp::apps {

namespace {

/// Several processes share the processors, so threads that wait must not spin.
std::vector<std::string> child_environment(const std::vector<std::string>& more) {
  std::vector<std::string> variables = {"OMP_WAIT_POLICY=passive"};
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (!std::string_view(*entry).starts_with("OMP_WAIT_POLICY=")) variables.emplace_back(*entry);
  for (const std::string& variable : more) {
    const std::string_view name = std::string_view(variable).substr(0, variable.find('=') + 1);
    if (std::ranges::none_of(variables, [&](const auto& has) { return has.starts_with(name); }))
      variables.push_back(variable);
  }
  return variables;
}

/// The last thing that the program said, which is why it ended; else the last line.
std::string last_words(const std::filesystem::path& log) {
  constexpr std::string_view name = "scarp: ";
  std::istringstream text(io::read_text(log));
  std::string last;
  std::string said;
  for (std::string line; std::getline(text, line);) {
    if (!io::trimmed(line).empty()) last = line;
    if (line.starts_with(name)) said = line.substr(name.size());
  }
  return said.empty() ? last : said;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  list.reserve(words.size() + 1);
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

/// In the child, between fork and exec: system calls only.
[[noreturn]] void become(char** arguments, char** environment, const char* log, pid_t parent) {
  // A group of its own: the terminal's Ctrl-C reaches the study alone, which then ends the runs.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int in = ::open("/dev/null", O_RDONLY);
  const int out = ::open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (::getppid() == parent && in >= 0 && out >= 0 && ::dup2(in, STDIN_FILENO) >= 0 &&
      ::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(out, STDERR_FILENO) >= 0) {
    ::close(in);
    ::close(out);
    ::execve("/proc/self/exe", arguments, environment);
  }
  ::_exit(127);
}

} // namespace

std::string failure_of(const Ending& ending, const std::filesystem::path& log) {
  if (ending.signal != 0)
    return fmt::format("killed by signal {} ({})", ending.signal, ::strsignal(ending.signal));
  if (ending.exit_code == 0) return "";
  const std::string words = std::filesystem::exists(log) ? last_words(log) : "";
  return words.empty() ? fmt::format("exit code {}", ending.exit_code) : words;
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const std::filesystem::path& log,
                           const std::vector<std::string>& variables) {
  std::vector<std::string> words = {"scarp"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = child_environment(variables);
  const std::vector<char*> argument_list = pointers(words);
  const std::vector<char*> variable_list = pointers(environment);
  const pid_t parent = ::getpid();
  id_ = ::fork();
  if (id_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (id_ == 0)
    become(const_cast<char**>(argument_list.data()), const_cast<char**>(variable_list.data()),
           log.c_str(), parent);
}

ChildProcess::~ChildProcess() {
  if (id_ < 0) return;
  ::kill(id_, SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

bool ChildProcess::has_ended() {
  if (id_ < 0) return true;
  int status = 0;
  if (::waitpid(id_, &status, WNOHANG) != id_) return false;
  id_ = -1;
  if (WIFEXITED(status)) ending_.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending_.signal = WTERMSIG(status);
  return true;
}

Signals::Signals() {
  ::sigemptyset(&awaited_);
  ::sigaddset(&awaited_, SIGCHLD);
  std::signal(SIGCHLD, SIG_DFL); // ignored, it would take the children's endings away
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction action = {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) ::sigaddset(&awaited_, signal);
  }
  ::sigprocmask(SIG_BLOCK, &awaited_, &before_);
}

Signals::~Signals() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

int Signals::wait(std::chrono::milliseconds longest) const {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(longest);
  const timespec time = {.tv_sec = seconds.count(),
                         .tv_nsec = std::chrono::nanoseconds(longest - seconds).count()};
  const int signal = ::sigtimedwait(&awaited_, nullptr, &time);
  return signal == SIGCHLD || signal < 0 ? 0 : signal;
}

} // namespace scarp::apps
