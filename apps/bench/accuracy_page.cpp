#include "apps/bench/accuracy.hpp"

#include "apps/html_page.hpp"
#include "core/version.hpp"
#include "io/atomic_file.hpp"
#include "render/chart_panels.hpp"

#include <fmt/format.h>

namespace scarp::bench {

namespace {

constexpr int width = 1600; // px

std::filesystem::path draw(const AccuracyOptions& options, const std::string& name,
                           const std::vector<render::Chart>& panels, bool shared_legend) {
  std::filesystem::path file = options.out / (name + ".png");
  const bool several = panels.size() > 1;
  constexpr int height = 1000; // px, of a figure with one panel
  render::write_png(file, render::render_chart_panels(panels, {.columns = 2,
                                                               .letters = several,
                                                               .shared_legend = shared_legend,
                                                               .width = width,
                                                               .height = several ? 0 : height}));
  return file;
}

void add_checks(apps::HtmlPage& page, const std::vector<CaseResult>& cases) {
  std::vector<std::vector<std::string>> rows;
  for (const CaseResult& result : cases) {
    for (const Check& check : result.report.checks)
      rows.push_back({result.origin->name + "." + check.name, check.pass() ? "passed" : "FAILED",
                      fmt::format("{:.5g}", check.value), check.demand(), check.unit});
    if (!result.failure.empty())
      rows.push_back({result.origin->name + ".run", "FAILED", "-", "runs to its end", "-"});
  }
  page.table("Every check: measured, and what was demanded before it was",
             {"check", "", "measured", "demanded", "unit"}, rows);
}

void add_case(apps::HtmlPage& page, const AccuracyOptions& options, const CaseResult& result) {
  page.heading(result.origin->title);
  if (!result.failure.empty()) page.paragraph("The run failed: " + result.failure);
  std::vector<std::vector<std::string>> rows;
  for (const Check& check : result.report.checks)
    rows.push_back({check.name, check.source, check.note});
  if (!rows.empty()) page.table("Where the references are from", {"check", "source", "note"}, rows);
  for (const Convergence& one : result.report.convergence) {
    std::vector<std::string> sizes = {"cell size"}, errors = {"error"};
    for (std::size_t i = 0; i < one.error.size(); ++i) {
      sizes.push_back(fmt::format("{:.4g}", one.cell_size[i]));
      errors.push_back(fmt::format("{:.3e}", one.error[i]));
    }
    page.table(fmt::format("{}: order {:.2f}", one.name, one.order()), sizes, {errors});
  }
  if (!result.report.figure.empty())
    page.picture(draw(options, result.origin->name, result.report.figure, false),
                 result.report.caption);
}

void add_work(apps::HtmlPage& page, const AccuracyOptions& options, const WorkResult& result) {
  page.picture(draw(options, result.name(), work_figure(result), true), result.title());
  const std::vector<render::Chart> answer = answer_figure(result);
  if (answer.empty()) return;
  const std::string& name = result.origin->converged->answer;
  page.picture(draw(options, result.name() + "-answer", answer, false),
               name + " over the cell size, and what it is extrapolated to (Richardson), with the "
                      "grid convergence index of Roache 1994 as the bar");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [method, converged] : result.verdicts)
    rows.push_back({method, answers_of(result, method), converged.verdict});
  page.table("Coarse to fine, and what that converges to", {"method", name, "converged solution"},
             rows);
}

/// All of them in one picture, for README.md: scenes by their titles' first words.
void draw_overview(const AccuracyOptions& options, const std::vector<WorkResult>& work) {
  std::vector<render::Chart> panels;
  for (const WorkResult& result : work)
    for (render::Chart& chart : work_figure(result)) {
      chart.style.title = result.title().substr(0, result.title().find(':'));
      panels.push_back(std::move(chart));
    }
  constexpr int wide = 2800;    // px, of which words take as much as in a picture of half the width
  constexpr double font = 26.0; // px
  render::write_png(options.out / "work_precision.png",
                    render::render_chart_panels(panels, {.columns = 4,
                                                         .letters = false,
                                                         .shared_legend = true,
                                                         .width = wide,
                                                         .font_size = font}));
}

} // namespace

void write_page(const AccuracyOptions& options, const std::vector<CaseResult>& cases,
                const std::vector<WorkResult>& work, double wall) {
  apps::HtmlPage page("Accuracy of scarp");
  page.paragraph(fmt::format("scarp {}, `scarp bench accuracy{}`, {:.0f} s of wall time.", version,
                             options.quick ? " --quick" : "", wall));
  if (!cases.empty()) {
    page.heading("Verification");
    add_checks(page, cases);
  }
  for (const CaseResult& result : cases) add_case(page, options, result);
  if (!work.empty()) {
    page.heading("Work and precision");
    page.paragraph("A line is a way to compute, its points are cell sizes. Ringed: no run that was "
                   "tried has less error for less work (the Pareto front). Vertical lines, "
                   "over wall time: where an error to the converged solution lies; the marker is "
                   "the least it can be where the line goes up to the end.");
    draw_overview(options, work);
  }
  for (const WorkResult& result : work) add_work(page, options, result);
  io::write_atomically(options.out / "index.html", page.text());
}

} // namespace scarp::bench
