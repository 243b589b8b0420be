// scarp reproduce NAME
#include "apps/bui2008.hpp"
#include "apps/commands.hpp"
#include "apps/wu2017.hpp"

#include <memory>

namespace scarp::apps {

void add_reproduce(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("reproduce", "Run a published case and set it beside its reference.");
  command->require_subcommand(1);

  const auto options = std::make_shared<Bui2008Options>();
  CLI::App* bui = command->add_subcommand(
      "bui2008",
      "Collapse of a pile of aluminium rods (Bui et al. 2008; Wu et al. 2017, fig. 2-5)");
  bui->add_option("--out", options->out, "Directory for the results")->required();
  bui->add_option("--cell", options->cell_size,
                  "Cell size, m; 0.001 is the paper's (80 000 points)")
      ->capture_default_str();
  std::vector<std::string> models;
  std::string says = "What the rods and the base do:";
  for (const auto& [name, model] : pile_models()) {
    models.push_back(name);
    says += " " + name + " (" + model.help + ")";
  }
  bui->add_option("--model", options->model, says)
      ->capture_default_str()
      ->check(CLI::IsMember(models));
  bui->add_option("--threads", options->threads, "Threads; default: all there are")
      ->check(CLI::Range(1, 1024));
  bui->add_option("--set", options->set, "key=value that overrides the scene; repeatable")
      ->allow_extra_args(false);
  bui->footer("Example:\n  scarp reproduce bui2008 --out out/bui2008 --cell 0.0025");
  bui->callback([options] { reproduce_bui2008(*options); });

  const auto slope = std::make_shared<Wu2017Options>();
  CLI::App* wu = command->add_subcommand(
      "wu2017", "Surcharge-induced landslide (Wu et al. 2017, fig. 6-12, table 1, eqs. 20-27)");
  wu->add_option("--out", slope->out, "Directory for the results")->required();
  add_jobs(*wu, slope->jobs, "Runs");
  wu->add_option("--set", slope->set, "key=value that overrides the scene of all runs; repeatable")
      ->allow_extra_args(false);
  wu->footer("Finished scenarios are kept: a call that was stopped goes on where it was.\n"
             "Example:\n  scarp reproduce wu2017 --out out/wu2017");
  wu->callback([slope] { reproduce_wu2017(*slope); });
}

} // namespace scarp::apps
