// scarp study STUDY.toml --out DIR
#include "apps/commands.hpp"
#include "apps/study_results.hpp"
#include "apps/study_runner.hpp"

#include "apps/usage.hpp"
#include "io/text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <memory>

namespace scarp::apps {

namespace {

struct StudyArguments {
  std::filesystem::path study;
  std::string shard;
  bool collect = false;
  StudyOptions run;
};

/// "I/N", I from 1 to N.  Throws UsageError.
StudyShard shard_of(const std::string& text) {
  StudyShard shard;
  const char* end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = has_slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  if (!has_slash || count.ec != std::errc() || count.ptr != end || shard.index < 1 ||
      shard.index > shard.count)
    throw UsageError(fmt::format("--shard {}: must be I/N, such as 1/4, with I from 1 to N", text));
  return shard;
}

std::filesystem::path results_file(const std::filesystem::path& directory) {
  return directory / "results.csv";
}

void collect(const io::Study& study, const std::filesystem::path& directory) {
  const StudyResults results = collect_results(study, directory);
  if (results.scenarios.empty())
    throw UsageError(fmt::format("--collect: none of the {} scenarios has finished in {}",
                                 study.scenarios.size(), directory.string()));
  write_results(results_file(directory), results);
  fmt::print("{} of {} scenarios in {}", results.scenarios.size(), study.scenarios.size(),
             results_file(directory).string());
  if (!results.missing.empty())
    fmt::print("; {} missing: {}", results.missing.size(), fmt::join(results.missing, ", "));
  fmt::print("\n");
}

void run(const io::Study& study, const StudyOptions& options) {
  const StudyOutcome outcome = run_study(study, options);
  const std::size_t new_ones = outcome.finished - outcome.kept;
  std::string summary = fmt::format("{} of {} scenarios finished ({} in this call, {:.0f} s)",
                                    outcome.finished, outcome.scenarios, new_ones, outcome.wall);
  if (outcome.signal != 0)
    throw std::runtime_error(fmt::format("stopped ({}); {}", ::strsignal(outcome.signal), summary));
  if (!outcome.failed.empty()) summary += fmt::format(", {} failed", outcome.failed.size());
  if (options.shard.count == 1) {
    write_results(results_file(options.out), collect_results(study, options.out));
    summary += "; results in " + results_file(options.out).string();
  }
  if (!outcome.failed.empty()) throw std::runtime_error(summary);
  fmt::print("{}\n", summary);
}

} // namespace

void add_study(CLI::App& program) {
  const auto options = std::make_shared<StudyArguments>();
  CLI::App* command =
      program.add_subcommand("study", "Run the scenarios of a parameter study side by side.");
  command
      ->add_option("study", options->study,
                   "Study file (TOML); `scarp options --study` lists its keys")
      ->required();
  command->add_option("--out", options->run.out, "Directory for the runs and results.csv")
      ->required();
  add_jobs(*command, options->run.jobs, "Runs");
  command->add_option("--threads", options->run.threads, "Threads of each run")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  CLI::Option* shard = command->add_option(
      "--shard", options->shard,
      "I/N: only every N-th scenario, from the I-th on, for N calls on one or more machines");
  command
      ->add_flag("--collect", options->collect,
                 "Run nothing; write results.csv from what has finished")
      ->excludes(shard);
  command->footer(
      "Finished scenarios are kept: the same call again goes on where the last one ended.\n"
      "Example:\n  scarp study data/studies/wu2017.toml --out out/wu2017 --jobs 8");
  command->callback([options] {
    if (!options->shard.empty()) options->run.shard = shard_of(options->shard);
    const io::Study study = io::read_study(options->study);
    if (options->collect)
      collect(study, options->run.out);
    else
      run(study, options->run);
  });
}

} // namespace scarp::apps
