// The subcommands of the program.  Each adds its options to the command line and, chosen, runs.
#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace scarp::apps {

/// What the user asked for cannot be done as asked: exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

void add_run(CLI::App& program);
void add_render(CLI::App& program);
void add_reproduce(CLI::App& program);
void add_info(CLI::App& program);
void add_options(CLI::App& program);
void add_study(CLI::App& program);
void add_safety(CLI::App& program);
void add_stress(CLI::App& program);
void add_bench(CLI::App& program);

/// The option --jobs of a command that does WHAT side by side; `jobs` stays 0 unless it is given.
CLI::Option* add_jobs(CLI::App& command, int& jobs, const std::string& what);

/// As many as were asked for; 0: as many as there are processors for this program.
std::size_t job_count(int jobs);

/// Makes a directory for results; throws UsageError if something else has that name.
void make_directory(const std::filesystem::path& directory);

} // namespace scarp::apps
