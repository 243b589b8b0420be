#include "tests/end_to_end/study_fixture.hpp"

#include "io/text.hpp"

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace scarp::test {

void StudyTest::write(const std::string& file, const std::string& text) const {
  std::ofstream(*this / file) << text;
}

void StudyTest::change_study(const std::string& old_text, const std::string& new_text) const {
  std::string text = content(*this / "study.toml");
  const std::size_t at = text.find(old_text);
  if (at == std::string::npos) throw std::runtime_error("the study has no " + old_text);
  write("study.toml", text.replace(at, old_text.size(), new_text));
}

std::vector<std::string> StudyTest::study_words(const std::vector<std::string>& more) const {
  std::vector<std::string> words = {"study", "study.toml", "--out", "out", "--jobs", "2"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::map<std::string, fs::file_time_type> StudyTest::times(const fs::path& directory) const {
  std::map<std::string, fs::file_time_type> times;
  for (const auto& entry : fs::recursive_directory_iterator(*this / directory))
    times[entry.path().string()] = entry.last_write_time();
  return times;
}

std::map<std::string, std::map<std::string, double>> results_in(const fs::path& directory) {
  const io::TextTable table = io::read_text_table(directory / "results.csv");
  std::map<std::string, std::map<std::string, double>> results;
  for (const std::vector<std::string>& row : table.rows)
    for (std::size_t i = 1; i < row.size(); ++i)
      results[row[0]][table.names[i]] = io::parse_number(row[i]);
  return results;
}

void await(const fs::path& file) {
  using std::chrono::steady_clock;
  const auto deadline = steady_clock::now() + std::chrono::minutes(1);
  while (!fs::exists(file)) {
    if (steady_clock::now() > deadline) throw std::runtime_error("no " + file.string());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

std::vector<std::string> processes_with(const std::string& text) {
  std::vector<std::string> ids;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream words(entry.path() / "cmdline", std::ios::binary);
    std::ostringstream all; // a process may end before it is read: then nothing comes
    all << words.rdbuf();
    if (all.str().find(text) != std::string::npos) ids.push_back(entry.path().filename().string());
  }
  return ids;
}

void expect_no_processes_with(const std::string& text) {
  using std::chrono::steady_clock;
  const auto deadline = steady_clock::now() + std::chrono::seconds(20);
  while (!processes_with(text).empty() && steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(processes_with(text), std::vector<std::string>());
}

} // namespace scarp::test
