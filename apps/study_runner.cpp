#include "apps/study_runner.hpp"

#include "apps/child_process.hpp"
#include "apps/file_lock.hpp"
#include "apps/study_plan.hpp"
#include "apps/study_progress.hpp"
#include "apps/study_results.hpp"
#include "apps/usage.hpp"
#include "io/atomic_file.hpp"
#include "io/file_descriptor.hpp"
#include "io/scene_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <system_error>

namespace scarp::apps {

namespace fs = std::filesystem;

namespace {

/// A run to be done: that of a scenario, or a beginning that scenarios wait for.
struct Task {
  enum class State { waiting, running, finished, failed };

  const PlannedRun* run = nullptr; ///< null: a beginning
  fs::path folder;                 ///< of the finished run
  fs::path own;                    ///< of this process: what .partial and .failed are added to
  std::vector<std::string> arguments;
  std::optional<std::size_t> after = {}; ///< the task that has to finish before
  State state = State::waiting;
  std::string failure = {}; ///< why, and where the log is
  std::unique_ptr<ChildProcess> process = {};

  fs::path partial() const { return fs::path(own) += ".partial"; }
  fs::path failed() const { return fs::path(own) += ".failed"; }
};

class StudyRun {
 public:
  StudyRun(const io::Study& study, const StudyPlan& plan, const StudyOptions& options)
      : study_(study), plan_(plan), options_(options) {
    jobs_ = job_count(options.jobs);
    if (options.shard.count == 1) remove_partial_beginnings();
    for (std::size_t i = options.shard.index - 1; i < plan.runs.size(); i += options.shard.count)
      prepare(plan.runs[i]);
  }

  StudyOutcome run() {
    const Signals signals;
    for (;;) {
      start_tasks();
      if (count(Task::State::waiting) + count(Task::State::running) == 0) break;
      show_progress();
      outcome_.signal = signals.wait(std::chrono::milliseconds(250));
      if (outcome_.signal != 0) break;
      for (Task& task : tasks_)
        if (task.state == Task::State::running && task.process->has_ended()) settle(task);
    }
    for (Task& task : tasks_) {
      if (task.state != Task::State::running) continue;
      task.process.reset();
      fs::remove_all(task.partial());
    }
    outcome_.wall = progress_.seconds();
    return outcome_;
  }

 private:
  /// Of a SIGKILLed process; its runs died with it.
  void remove_partial_beginnings() const {
    const fs::path shared = beginning_folder(options_.out, "");
    if (!fs::exists(shared)) return;
    std::vector<fs::path> left;
    for (const fs::directory_entry& entry : fs::directory_iterator(shared))
      if (entry.path().extension() == ".partial") left.push_back(entry.path());
    for (const fs::path& folder : left) fs::remove_all(folder);
  }

  /// Makes the task of a run, and that of its beginning, unless they have finished.
  void prepare(const PlannedRun& run) {
    ++outcome_.scenarios;
    const fs::path folder = options_.out / run.name;
    Task task{.run = &run, .folder = folder, .own = folder, .arguments = {}};
    fs::remove_all(task.partial());
    if (const auto record = finished_record(folder)) {
      if (is_record_of(*record, run)) {
        ++outcome_.kept;
        ++outcome_.finished;
        return;
      }
      fmt::print("scenario {} is run again: its scene is another than before\n", run.name);
    } else if (fs::exists(folder)) {
      throw UsageError(
          fmt::format("{} is in the way of a scenario, and is no finished run", folder.string()));
    }
    task.arguments = {"run", study_.scene.string()};
    for (const std::string& text : run.overrides)
      task.arguments.insert(task.arguments.end(), {"--set", text});
    if (plan_.beginnings.contains(run.beginning)) {
      const fs::path beginning = beginning_folder(fs::absolute(options_.out), run.beginning);
      task.after = beginning_task(run.beginning);
      task.arguments.insert(
          task.arguments.end(),
          {"--set", fmt::format("stage.{}.begin_from={}", run.scene.stages.back().name,
                                nlohmann::json(beginning.lexically_normal().string()).dump())});
    }
    tasks_.push_back(std::move(task));
  }

  std::size_t beginning_task(const std::string& name) {
    const auto [place, is_new] = beginning_tasks_.emplace(name, tasks_.size());
    if (!is_new) return place->second;
    const fs::path folder = beginning_folder(options_.out, name);
    const fs::path own = fs::path(folder) +=
        fmt::format(".{}-of-{}", options_.shard.index, options_.shard.count);
    tasks_.push_back({.run = nullptr, .folder = folder, .own = own, .arguments = {}});
    const fs::path scene = tasks_.back().partial() / "beginning.toml";
    tasks_.back().arguments = {"run", scene.string()};
    return place->second;
  }

  std::size_t count(Task::State state) const {
    return static_cast<std::size_t>(std::ranges::count(tasks_, state, &Task::state));
  }

  void start_tasks() {
    std::size_t running = count(Task::State::running);
    for (Task& task : tasks_) {
      if (running >= jobs_) return;
      if (task.state != Task::State::waiting) continue;
      const Task* before = task.after ? &tasks_[*task.after] : nullptr;
      if (before != nullptr && before->state == Task::State::failed)
        fail(task, "its shared beginning failed: " + before->failure);
      else if (before == nullptr || before->state == Task::State::finished)
        start(task);
      if (task.state == Task::State::running) ++running;
    }
  }

  void start(Task& task) {
    // In the meantime another shard may have done it.
    if (task.run == nullptr && finished_record(task.folder)) {
      task.state = Task::State::finished;
      return;
    }
    fs::remove_all(task.failed());
    fs::remove_all(task.partial());
    if (task.run != nullptr) fs::remove_all(task.folder);
    fs::create_directories(task.partial());
    if (task.run == nullptr)
      io::write_atomically(task.arguments[1],
                           io::scene_to_toml(plan_.beginnings.at(task.folder.filename().string())));
    std::vector<std::string> arguments = task.arguments;
    arguments.insert(arguments.end(), {"--out", task.partial().string(), "--threads",
                                       std::to_string(options_.threads)});
    task.process = std::make_unique<ChildProcess>(arguments, task.partial() / "log.txt");
    task.state = Task::State::running;
  }

  void settle(Task& task) {
    std::string failure = failure_of(task.process->ending(), task.partial() / "log.txt");
    task.process.reset();
    if (failure.empty()) {
      const auto record = finished_record(task.partial());
      if (!record || (task.run != nullptr && !is_record_of(*record, *task.run)))
        failure = "the run has left no record of this scene: has its file changed?";
    }
    if (!failure.empty()) {
      fs::rename(task.partial(), task.failed());
      fail(task, fmt::format("{} ({})", failure, (task.failed() / "log.txt").string()));
      return;
    }
    std::error_code error;
    fs::rename(task.partial(), task.folder, error);
    if (error && task.run == nullptr && finished_record(task.folder))
      fs::remove_all(task.partial()); // another shard was first
    else if (error)
      throw fs::filesystem_error("cannot rename", task.partial(), task.folder, error);
    io::sync_directory(task.folder.parent_path());
    task.state = Task::State::finished;
    if (task.run != nullptr) ++outcome_.finished;
  }

  void fail(Task& task, const std::string& failure) {
    task.state = Task::State::failed;
    task.failure = failure;
    if (task.run == nullptr) return; // its scenarios tell
    outcome_.failed.push_back(task.run->name);
    progress_.say(fmt::format("scenario {} failed: {}", task.run->name, failure));
  }

  void show_progress() {
    const std::size_t done = count(Task::State::finished) + count(Task::State::failed);
    progress_.show({.scenarios = outcome_.scenarios,
                    .finished = outcome_.finished,
                    .failed = outcome_.failed.size(),
                    .running = count(Task::State::running),
                    .part = static_cast<double>(done) / static_cast<double>(tasks_.size())});
  }

  const io::Study& study_;
  const StudyPlan& plan_;
  const StudyOptions& options_;
  std::size_t jobs_;
  std::vector<Task> tasks_; ///< a beginning before the runs that wait for it
  std::map<std::string, std::size_t> beginning_tasks_;
  StudyOutcome outcome_;
  StudyProgress progress_;
};

} // namespace

StudyOutcome run_study(const io::Study& study, const StudyOptions& options) {
  const StudyPlan plan = plan_study(study);
  result_columns(study, plan.runs.front().scene); // throws before the work, not after it
  make_directory(options.out);
  const auto& [index, count] = options.shard;
  // A study as a whole takes every folder, a shard those of its own scenarios.
  const FileLock whole(options.out / ".study.lock",
                       count == 1 ? FileLock::Kind::alone : FileLock::Kind::together);
  const FileLock part(options.out / fmt::format(".study-{}-of-{}.lock", index, count),
                      FileLock::Kind::alone);
  return StudyRun(study, plan, options).run();
}

} // namespace scarp::apps
