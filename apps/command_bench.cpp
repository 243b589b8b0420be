// scarp bench accuracy --out DIR [--quick] [--only NAME]...
// scarp bench speed --out DIR [--quick]
#include "apps/bench/accuracy.hpp"
#include "apps/bench/speed.hpp"
#include "apps/commands.hpp"
#include "apps/usage.hpp"

#include <memory>

namespace scarp::apps {

namespace {

void run(const bench::AccuracyOptions& options) {
  make_directory(options.out);
  if (!bench::run_accuracy(options))
    throw std::runtime_error("a verification failed; see " +
                             (options.out / "accuracy.json").string());
}

void add_accuracy(CLI::App& command) {
  const auto options = std::make_shared<bench::AccuracyOptions>();
  CLI::App* accuracy = command.add_subcommand(
      "accuracy", "Verify against closed forms and published references; error against work.");
  accuracy->add_option("--out", options->out, "Directory for accuracy.json, figures and a page")
      ->required();
  accuracy->add_flag("--quick", options->quick,
                     "Fewer refinements: two minutes on one core in all");
  accuracy
      ->add_option("--only", options->only, "A case or a work-precision scene to run; repeatable")
      ->allow_extra_args(false)
      ->check(CLI::IsMember(bench::names()));
  accuracy->footer("Exit code 1 if a verification fails.\n"
                   "Example:\n  scarp bench accuracy --out out/accuracy --quick");
  accuracy->callback([options] { run(*options); });
}

void add_speed(CLI::App& command) {
  const auto options = std::make_shared<bench::SpeedOptions>();
  CLI::App* speed = command.add_subcommand(
      "speed", "Points times steps a second, phase by phase, and what part of the machine's peak.");
  speed
      ->add_option("--out", options->out,
                   "Directory for speed.json, speed.csv, machine.json and speed.png")
      ->required();
  speed->add_flag("--quick", options->quick,
                  "One size instead of 10^4 to 10^7 points: under a minute");
  speed->footer("Bounds that are missed are said, and are no failure: exit code 0.\n"
                "Example:\n  scarp bench speed --out out/speed --quick");
  speed->callback([options] {
    make_directory(options->out);
    bench::run_speed(*options);
  });
}

} // namespace

void add_bench(CLI::App& program) {
  CLI::App* command = program.add_subcommand("bench", "Measure the solver.");
  command->require_subcommand(1);
  add_accuracy(*command);
  add_speed(*command);
}

} // namespace scarp::apps
