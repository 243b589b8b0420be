// scarp: landslides by the material point method.
//
//   scarp run data/scenes/bui2008.toml --out out/pile
//   scarp render out/pile --field velocity --frames last
//   scarp reproduce bui2008 --out out/bui2008
//
// Exit codes: 0 done; 1 the run failed; 2 the command line or the scene is wrong.
#include "apps/commands.hpp"
#include "apps/usage.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "io/scene_file.hpp"
#include "io/text.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

/// libgomp's threads wait for each other by spinning, by default so long that on a machine shared
/// with other work a run takes a hundred times as long.  libgomp reads its settings before main, so
/// the program starts itself again with a bounded spin unless the user has chosen: as long as the
/// parts of a step differ on a quiet machine, 1000 turns; beside three compilers on two cores
/// 10 000 turns take 4 to 8 times as long as 1000.
void bound_openmp_spinning(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  ::setenv("GOMP_SPINCOUNT", "1000", 1);
  ::execv("/proc/self/exe", argv); // returns only if it fails; then the run is merely slower
}

int report(const char* kind, const std::exception& error, int code) {
  std::fprintf(stderr, "scarp: %s%s\n", kind, error.what());
  return code;
}

/// What is wrong with the command line, and where more is said.
std::string mistake(const CLI::App* program, const CLI::Error& error) {
  const CLI::App* command = program;
  std::string call = program->get_name();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    call += " " + command->get_name();
  }
  std::string what = error.what();
  if (command->get_require_subcommand_min() > 0) { // CLI11 would say only that there is none
    std::vector<std::string> names;
    for (const CLI::App* each : command->get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(each->get_name());
    const std::vector<std::string> given = program->remaining(true);
    const std::string hint = given.empty() ? "" : scarp::io::did_you_mean(given.front(), names);
    what = (given.empty() ? "a command is missing" : "'" + given.front() + "' is unknown") +
           "; must be " + scarp::io::quoted_list(names, "or") +
           (hint.empty() ? "" : " (" + hint + ")");
  }
  return "scarp: " + what + "; " + call + " --help says more\n";
}

} // namespace

int main(int argc, char** argv) {
  bound_openmp_spinning(argv);
  try {
    CLI::App program{"Landslides by the material point method: solver, VTK series, figures."};
    program.name("scarp");
    program.set_version_flag("--version", std::string("scarp ") + scarp::version);
    program.require_subcommand(1);
    program.failure_message(mistake);
    program.footer(
        "Examples:\n"
        "  scarp run data/scenes/bui2008.toml --out out/pile\n"
        "  scarp render out/pile --field velocity --frames last\n"
        "  scarp reproduce bui2008 --out out/bui2008\n"
        "Exit codes: 0 done, 1 the run failed, 2 the command line or the scene is wrong.");
    scarp::apps::add_run(program);
    scarp::apps::add_render(program);
    scarp::apps::add_reproduce(program);
    scarp::apps::add_info(program);
    scarp::apps::add_options(program);
    scarp::apps::add_study(program);
    scarp::apps::add_safety(program);
    scarp::apps::add_stress(program);
    scarp::apps::add_bench(program);
    try {
      program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return program.exit(error) == 0 ? 0 : 2;
    }
    return 0;
  } catch (const scarp::apps::UsageError& error) {
    return report("", error, 2);
  } catch (const scarp::io::SceneError& error) {
    return report("", error, 2);
  } catch (const scarp::SetupError& error) {
    return report("", error, 2);
  } catch (const scarp::RunError& error) {
    return report("the run failed: ", error, 1);
  } catch (const std::exception& error) {
    return report("", error, 1);
  }
}
