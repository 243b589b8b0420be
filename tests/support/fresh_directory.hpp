// Where tests write.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace scarp::test {

/// A part of the temporary directory that is this process's own, so that runs of the tests side by
/// side do not meet.  It goes with the process, unless a test failed.
class ProcessDirectory {
 public:
  ProcessDirectory() {
    std::string name = (std::filesystem::path(testing::TempDir()) / "scarp_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    path_ = name;
  }
  ProcessDirectory(const ProcessDirectory&) = delete;
  ProcessDirectory& operator=(const ProcessDirectory&) = delete;
  ~ProcessDirectory() {
    std::error_code ignored;
    if (!testing::UnitTest::GetInstance()->Failed()) std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// An empty directory of the running test's own.
inline std::filesystem::path fresh_directory() {
  static const ProcessDirectory of_process;
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test.test_suite_name()) + "_" + test.name();
  std::ranges::replace(name, '/', '_');
  const std::filesystem::path directory = of_process.path() / name;
  std::filesystem::remove_all(directory);
  std::filesystem::create_directory(directory);
  return directory;
}

} // namespace scarp::test
