// The subcommands of the program.  Each adds its options to the command line and, chosen, runs.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace scarp::apps {

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

} // namespace scarp::apps
