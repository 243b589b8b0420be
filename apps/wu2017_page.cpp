#include "apps/wu2017_page.hpp"

#include "apps/html_page.hpp"
#include "core/version.hpp"
#include "io/atomic_file.hpp"
#include "io/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace scarp::apps {

namespace {

std::string fixed(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string per_cent(double computed, double paper) {
  return fmt::format("{:+.1f} %", 100.0 * (computed / paper - 1.0));
}

void print_table(const ReportTable& table) {
  std::vector<std::size_t> widths;
  const auto length = [](const std::string& cell) { // of UTF-8
    return static_cast<std::size_t>(
        std::ranges::count_if(cell, [](char c) { return (c & 0xC0) != 0x80; }));
  };
  for (std::size_t column = 0; column < table.header.size(); ++column) {
    widths.push_back(length(table.header[column]));
    for (const auto& row : table.rows)
      widths[column] = std::max(widths[column], length(row[column]));
  }
  const auto print_row = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t column = 0; column < cells.size(); ++column) {
      const std::string gap(widths[column] - length(cells[column]), ' ');
      line += column == 0 ? cells[column] + gap : "  " + gap + cells[column];
    }
    fmt::print("{}\n", line);
  };
  fmt::print("\n{}\n", table.caption);
  print_row(table.header);
  for (const auto& row : table.rows) print_row(row);
}

} // namespace

Wu2017Report::Wu2017Report(const Wu2017& results, const analysis::MeasureOptions& measure)
    : results_(results), measure_(measure) {}

ReportTable Wu2017Report::base_case() const {
  const BaseCase& base = results_.base;
  const auto peak = [&](std::size_t monitor) {
    return fixed(base.measures.monitors.at(monitor).velocity.value, 2);
  };
  const double points =
      results_.computed.rows() > 0 ? results_.computed.column("points").front() : std::nan("");
  std::vector<std::vector<std::string>> rows = {
      {"points", "10975", fixed(points, 0)},
      {"peak horizontal velocity of A, m/s", "5.0", peak(0)},
      {"peak horizontal velocity of B, m/s", "5.8", peak(1)},
      {"peak horizontal velocity of C, m/s", "1.86 (text: 1.5)", peak(2)},
      {"peak acceleration of C, m/s\u00b2", "0.82",
       fixed(base.measures.monitors.at(2).acceleration.value, 2)},
      {"creep of C, m/s", "about 0.45",
       base.stages ? fixed(base.stages->creep_velocity, 2) : "not found"},
      {"C leaves its creep, s", "4",
       base.stages ? fixed(base.stages->acceleration, 1) : "not found"},
      {"acceleration ends, A / B / C, s", "6-7",
       fmt::format("{:.1f} / {:.1f} / {:.1f}", base.measures.monitors.at(0).velocity.time,
                   base.measures.monitors.at(1).velocity.time,
                   base.measures.monitors.at(2).velocity.time)},
      {"peak kinetic energy, kJ per 0.5 m", "3596",
       fixed(1e-3 * base.measures.kinetic_energy.value, 0)},
      {"at rest, s", "about 10", fixed(base.measures.rest.value_or(std::nan("")), 2)},
      {"run-out beyond the toe, m", "17", fixed(base.measures.run_out, 1)},
      {"points thrown off", "-", fmt::format("{}", base.thrown)}};
  return {"Base case (scenario 3: c = 20 kPa, \u03c6 = 25\u00b0, 294 kPa), as a run of its own",
          {"", "paper", "scarp"},
          rows};
}

ReportTable Wu2017Report::agreements() const {
  ReportTable table{
      fmt::format("Agreement over {} scenarios", results_.scenarios.size()),
      {"", "R\u00b2 of a line", "R\u00b2 about equality", "mean difference", "largest"},
      {}};
  for (const Quantity& quantity : quantities()) {
    const auto& paper = results_.paper.column(quantity.paper);
    const auto& computed = results_.computed.column(quantity.column);
    const Agreement agreed = agreement(paper, computed);
    const int digits = quantity.digits + 1;
    table.rows.push_back({fmt::format("{}, {}", quantity.name, quantity.unit),
                          fixed(agreed.correlation, 3), fixed(agreed.equality, 3),
                          fixed(agreed.mean_error, digits), fixed(agreed.largest_error, digits)});
  }
  std::vector<double> relative;
  const Quantity& energy = quantities().back();
  for (std::size_t i = 0; i < results_.scenarios.size(); ++i)
    relative.push_back(std::abs(
        results_.computed.column(energy.column)[i] / results_.paper.column(energy.paper)[i] - 1.0));
  double mean = 0.0;
  for (const double part : relative) mean += part / static_cast<double>(relative.size());
  table.rows.push_back({"peak kinetic energy, relative", "", "",
                        fmt::format("{:.2f} %", 100 * mean),
                        fmt::format("{:.2f} %", 100 * std::ranges::max(relative))});
  return table;
}

ReportTable Wu2017Report::scenarios() const {
  ReportTable table{
      "Table 1: paper / scarp", {"scenario", "c, kPa", "\u03c6, \u00b0", "p, kPa"}, {}};
  for (const Quantity& quantity : quantities()) {
    table.header.push_back(fmt::format("{}, {}", quantity.symbol, quantity.unit));
    table.header.emplace_back("scarp");
  }
  table.header.insert(table.header.end(), {"E error", "rest, s", "thrown", "after rest"});
  const auto cell = [&](const char* column, std::size_t row, int digits) {
    return fixed(results_.computed.column(column)[row], digits);
  };
  for (std::size_t row = 0; row < results_.scenarios.size(); ++row) {
    std::vector<std::string> cells = {results_.scenarios[row]};
    for (const std::string& input : predictors()) cells.push_back(cell(input.c_str(), row, 0));
    for (const Quantity& quantity : quantities()) {
      const double paper = results_.paper.column(quantity.paper)[row];
      const int paper_digits = quantity.key == "runout_m" ? 0 : quantity.digits;
      cells.push_back(fixed(paper, paper_digits));
      cells.push_back(cell(quantity.column.c_str(), row, quantity.digits));
    }
    const Quantity& energy = quantities().back();
    cells.push_back(per_cent(results_.computed.column(energy.column)[row],
                             results_.paper.column(energy.paper)[row]));
    cells.push_back(cell("rest_time_s", row, 2));
    cells.push_back(cell("thrown_points", row, 0));
    cells.push_back(cell("after_rest_fraction", row, 4));
    table.rows.push_back(cells);
  }
  return table;
}

ReportTable Wu2017Report::fits() const {
  ReportTable table{"Fits of the base case's velocities (eqs. 20-23), \u00b1 standard error",
                    {"monitor, part", "from, s", "to, s", "curve", "R\u00b2"},
                    {}};
  for (const FittedCurve& curve : results_.base.fits) {
    std::string parameters = "none fits";
    if (curve.fit) {
      parameters = curve.what.ends_with("Gaussian")
                       ? "v = y0 + a exp(-(t - t0)\u00b2/(2 w\u00b2)): "
                       : "v = y0 + a exp(-t/\u03c4): ";
      for (std::size_t i = 0; i < curve.fit->names.size(); ++i)
        parameters +=
            fmt::format("{}{} = {:.4g} \u00b1 {:.2g}", i == 0 ? "" : ", ", curve.fit->names[i],
                        curve.fit->values[i], curve.fit->standard_errors[i]);
    }
    table.rows.push_back({fmt::format("{}, {}", curve.monitor, curve.what), fixed(curve.from, 2),
                          fixed(curve.to, 2), parameters,
                          curve.fit ? fixed(curve.fit->r2, 3) : "-"});
  }
  return table;
}

ReportTable Wu2017Report::regression(const Regressions& regressions,
                                     const std::string& caption) const {
  ReportTable table{
      caption, {"", "b0", "c, per kPa", "\u03c6, per \u00b0", "p, per kPa", "R\u00b2"}, {}};
  for (const Quantity& quantity : quantities()) {
    const analysis::Regression& r = regressions.at(quantity.key);
    std::vector<std::string> cells = {fmt::format("{}, {}", quantity.name, quantity.unit)};
    for (std::size_t i = 0; i < r.coefficients.size(); ++i)
      cells.push_back(fmt::format("{:.4g} \u00b1 {:.2g}", r.coefficients[i], r.standard_errors[i]));
    cells.push_back(fixed(r.r2, 3));
    table.rows.push_back(cells);
  }
  return table;
}

std::vector<std::string> Wu2017Report::equations() const {
  std::vector<std::string> lines;
  for (const Quantity& quantity : quantities())
    lines.push_back(fmt::format("{}    ({} in {}; R\u00b2 = {:.3f})",
                                equation(quantity, results_.of_computed->at(quantity.key)),
                                quantity.symbol, quantity.unit,
                                results_.of_computed->at(quantity.key).r2));
  lines.emplace_back("c in kPa, \u03c6 in degrees, p in kPa; fitted for c = 15-30, \u03c6 = 20-30, "
                     "p = 196-343, one varied at a time");
  return lines;
}

std::vector<std::string> Wu2017Report::definitions() const {
  return {
      fmt::format(
          "Velocities are horizontal, of the material point nearest to the monitor at time 0, "
          "recorded every {:.3g} s. They are smoothed by a least-squares parabola over {:.3g} s "
          "around each sample (Savitzky and Golay 1964); accelerations are its slope.",
          results_.base.scene.timing.history_interval, measure_.smoothing_width),
      fmt::format(
          "The width is the slope's first period in shear, 4 H / c = 4 x 35 m / 116 m/s = 1.2 s: "
          "what swings faster is elastic noise."),
      fmt::format(
          "Kinetic energy is that of the material points, for a slice of {:.3g} m, not smoothed.",
          measure_.thickness),
      fmt::format(
          "Run-out: largest x of a point of the slope or the surcharge at the end, beyond x = "
          "{:.3g} m.",
          measure_.toe),
      fmt::format(
          "At rest: from when on the kinetic energy of the nodes stays below {:.3g} of its peak. "
          "'After rest' is its largest part of the peak after {:.2g} s of rest: more than {:.3g} "
          "would be a gain.",
          measure_.rest_fraction, measure_.rest_duration, measure_.rest_fraction),
      fmt::format("Stages: II begins when C first has {} of its creep velocity (that at the least "
                  "acceleration before half of its peak) and ends when it has {}; IV begins with "
                  "the peak of the kinetic energy.",
                  "nine tenths", "eleven tenths")};
}

double Wu2017Report::run_time() const {
  double sum = 0.0;
  for (const double wall : results_.computed.column("wall_s")) sum += wall;
  return sum;
}

std::vector<std::string> Wu2017Report::differences() const {
  const auto values = [&](const Quantity& quantity, std::size_t row) {
    return std::pair(results_.paper.column(quantity.paper)[row],
                     results_.computed.column(quantity.column)[row]);
  };
  std::vector<std::string> lines;
  for (const Quantity& quantity : quantities()) {
    std::size_t worst = 0;
    const auto error = [&](std::size_t row) {
      const auto [paper, computed] = values(quantity, row);
      return std::abs(computed - paper);
    };
    for (std::size_t row = 0; row < results_.scenarios.size(); ++row)
      if (error(row) > error(worst)) worst = row;
    const auto [paper, computed] = values(quantity, worst);
    lines.push_back(fmt::format("{}: farthest from the paper in scenario {}, {} against {} {}.",
                                quantity.name, results_.scenarios[worst],
                                fixed(computed, quantity.digits), fixed(paper, quantity.digits),
                                quantity.unit));
  }
  lines.emplace_back(
      "The paper does not say how it filtered C's signal. C's velocity carries elastic noise: a "
      "shorter window raises both of C's peaks, that of the acceleration most.");
  lines.emplace_back("The residuals of the linear regressions curve upwards at both ends, on the "
                     "paper's table as on this one: the four quantities are not linear in the "
                     "friction angle over these ten degrees.");
  return lines;
}

void Wu2017Report::print() const {
  print_table(base_case());
  print_table(scenarios());
  print_table(agreements());
  print_table(fits());
  print_table(regression(results_.of_paper, "Regressions on the paper's table 1 (eqs. 24-27)"));
  if (results_.of_computed) {
    print_table(regression(*results_.of_computed, "Regressions on scarp's table (eqs. 24-27)"));
    fmt::print("\n");
    for (const std::string& line : equations()) fmt::print("{}\n", line);
  }
  for (const std::string& name : results_.failed) fmt::print("scenario {} failed\n", name);
  fmt::print("\n{:.0f} s of wall time\n", results_.wall);
}

void Wu2017Report::write_page(const std::filesystem::path& file,
                              const std::vector<Figure>& figures) const {
  HtmlPage page("Surcharge-induced landslide: Wu et al. 2017 and scarp");
  const auto add = [&](const ReportTable& table) {
    page.table(table.caption, table.header, table.rows);
  };
  const auto show = [&](const std::string& start) {
    for (const Figure& figure : figures)
      if (figure.caption.starts_with(start)) page.picture(figure.file, figure.caption);
  };
  page.paragraph(fmt::format(
      "Wu F., Zhang W., Shi B., Shi B., Zhang Y., Zheng S. (2017), Run-out characteristic "
      "simulation "
      "of a surcharge-induced soil landslide using the material point method, Hydrogeology & "
      "Engineering Geology 44(6):126-134, doi 10.16030/j.cnki.issn.1000-3665.2017.06.19, computed "
      "again by scarp {}. {} of {} scenarios ended well; all runs together took {:.0f} s of wall "
      "time, this call {:.0f} s (finished scenarios are kept).",
      version, results_.scenarios.size(), results_.scenarios.size() + results_.failed.size(),
      run_time(), results_.wall));
  for (const std::string& name : results_.failed)
    page.paragraph(fmt::format("Scenario {} failed; see scenarios/{}.failed/log.txt.", name, name));

  page.heading("Model");
  for (const char* name : {"Figure 6", "Figure 7", "Figure 8", "Figure 9"}) show(name);
  page.heading("Base case");
  add(base_case());
  for (const char* name : {"Figure 10", "Figure 11"}) show(name);
  add(fits());
  page.heading("29 scenarios");
  add(agreements());
  show("Paper against scarp");
  show("Figure 12");
  add(scenarios());
  page.heading("Where the two differ");
  for (const std::string& line : differences()) page.paragraph(line);
  page.heading("Predictive equations");
  add(regression(results_.of_paper, "Regressions on the paper's table 1 (eqs. 24-27)"));
  if (results_.of_computed) {
    add(regression(*results_.of_computed, "Regressions on scarp's table (eqs. 24-27)"));
    page.listing(equations());
    show("Residuals");
  }
  page.heading("What was measured, and how");
  for (const std::string& line : definitions()) page.paragraph(line);
  page.heading("What was run");
  page.paragraph("The base case; the scenarios differ from it in cohesion, friction angle and the "
                 "surcharge's multiple of gravity, and begin from one run of the first stage.");
  std::vector<std::string> lines;
  std::string line;
  for (const char c : io::scene_to_toml(results_.base.scene))
    if (c == '\n')
      lines.push_back(std::exchange(line, {}));
    else
      line += c;
  page.listing(lines);
  io::write_atomically(file, page.text());
}

} // namespace scarp::apps
