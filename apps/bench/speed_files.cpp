#include "apps/bench/speed.hpp"

#include "apps/bench/charts.hpp"
#include "core/version.hpp"
#include "io/atomic_file.hpp"
#include "io/json_record.hpp"
#include "render/chart_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scarp::bench {

namespace {

/// Under the names that the literature has for them.
std::string column_of(Phase phase) {
  switch (phase) {
  case Phase::scatter:
    return "P2G";
  case Phase::nodes:
    return "grid";
  case Phase::gather:
    return "G2P";
  case Phase::sort:
  case Phase::remap:
  case Phase::stress:
    break;
  }
  return name_of(phase);
}

/// As they stand in the table: one line a row, phases as columns of their own.
std::string csv_of(const std::vector<SpeedRow>& rows) {
  std::string header, lines;
  for (const SpeedRow& row : rows) {
    std::string names, values;
    const nlohmann::ordered_json flat = to_json(row);
    const auto add = [&](const std::string& name, const nlohmann::ordered_json& value) {
      names += (names.empty() ? "" : ",") + name;
      values += values.empty() ? "" : ",";
      values += value.is_null()     ? "nan"
                : value.is_string() ? value.get<std::string>()
                                    : value.dump();
    };
    for (const auto& [name, value] : flat.items()) {
      if (!value.is_object()) {
        add(name, value);
        continue;
      }
      for (const auto& [part, number] : value.items()) add(part + "_per_s", number);
    }
    header = names;
    lines += values + "\n";
  }
  return header + "\n" + lines;
}

nlohmann::ordered_json to_json(const Machine& machine) {
  nlohmann::ordered_json record = {{"version", version},
                                   {"processor", machine.processor},
                                   {"compiler", machine.compiler},
                                   {"processors", machine.processors},
                                   {"doubles_in_a_register", machine.lanes},
                                   {"load_before", machine.load},
                                   {"free_memory_B", machine.free_memory},
                                   {"largest_cache_B", machine.largest_cache},
                                   {"rooflines", nlohmann::ordered_json::array()}};
  for (const Roofline& one : machine.rooflines)
    record["rooflines"].push_back({{"threads", one.threads},
                                   {"flops_double_per_s", one.flops_double},
                                   {"flops_single_per_s", one.flops_single},
                                   {"memory_B_per_s", one.memory_bandwidth},
                                   {"cache_B_per_s", one.cache_bandwidth}});
  return record;
}

nlohmann::ordered_json to_json(const SpeedRatio& ratio) {
  nlohmann::ordered_json record = {{"name", ratio.name},
                                   {"value", ratio.value},
                                   {"undisturbed", ratio.alone},
                                   {"unit", ratio.unit}};
  if (ratio.bound) {
    record[ratio.kind == Bound::at_least ? "at_least" : "at_most"] = *ratio.bound;
    record["verdict"] = ratio.verdict();
  }
  return record;
}

/// The numbers of points of all rows between powers of ten.
render::Limits whole_decades(const std::vector<SpeedRow>& rows) {
  constexpr double slack = 0.1; // decades: 9800 points are ten thousand
  const auto [least, most] = std::ranges::minmax(rows, {}, &SpeedRow::points);
  const auto log = [](std::size_t points) { return std::log10(static_cast<double>(points)); };
  const double from = std::min(std::floor(log(least.points) + slack), log(least.points));
  const double to = std::max(std::ceil(log(most.points) - slack), log(most.points));
  return {std::pow(10.0, from - slack), std::pow(10.0, to + slack)};
}

render::Chart panel(const std::vector<SpeedRow>& rows, int dimension) {
  using namespace render;
  constexpr std::array colours = {palette::blue,   palette::vermilion, palette::green,
                                  palette::purple, palette::orange,    palette::sky};
  Chart chart;
  chart.style = {.x_name = "points",
                 .y_name = "points × steps a second",
                 .y_unit = "10⁶/s",
                 .notes = {"1 thread: by processor time; several: shortest repetition"},
                 .title = dimension == 2 ? "plane strain" : "3-D"};
  std::vector<std::string> methods; // a colour each
  for (const SpeedRow& row : rows) {
    const std::string method = row.how.name();
    const bool single = row.how.precision() != "double", alone = row.threads == 1;
    if (std::ranges::find(methods, method) == methods.end()) methods.push_back(method);
    if (row.dimension != dimension) continue;
    const auto k = static_cast<std::size_t>(std::ranges::find(methods, method) - methods.begin());
    const std::string label = fmt::format("{}{}, {} thread{}", method, single ? ", single" : "",
                                          row.threads, alone ? "" : "s");
    auto curve = std::ranges::find(chart.curves, label, &Curve::label);
    if (curve == chart.curves.end()) {
      chart.curves.push_back({.label = label,
                              .x = {},
                              .y = {},
                              .colour = colours[k % colours.size()],
                              .line = single ? LineKind::dashed : LineKind::solid,
                              .marker = alone ? Marker::circle : Marker::open_circle});
      curve = chart.curves.end() - 1;
    }
    curve->x.push_back(static_cast<double>(row.points));
    curve->y.push_back(row.alone / 1e6);
  }
  chart.style.x_limits = whole_decades(rows);
  return chart;
}

} // namespace

nlohmann::ordered_json to_json(const SpeedRow& row) {
  nlohmann::ordered_json record = {{"scene", "collapse"},
                                   {"dim", row.dimension},
                                   {"shape", row.how.shape()},
                                   {"transfer", row.how.transfer()},
                                   {"precision", row.how.precision()},
                                   {"threads", row.threads},
                                   {"points", row.points},
                                   {"point_steps_per_s", row.rate},
                                   {"undisturbed_point_steps_per_s", row.alone},
                                   {"spread", row.spread},
                                   {"flops_per_point_step", row.flops},
                                   {"fraction_of_peak_flops", row.part_of_flops},
                                   {"bytes_per_point", row.memory},
                                   {"bytes_per_point_step", row.bytes},
                                   {"fraction_of_bandwidth", row.part_of_bandwidth},
                                   {"yielded", row.yielded},
                                   {"phases", nlohmann::ordered_json::object()}};
  for (std::size_t k = 0; k < phase_count; ++k)
    record["phases"][column_of(static_cast<Phase>(k))] = row.phase_rate[k];
  record["phases"]["output"] = nullptr;
  if (row.output_rate) record["phases"]["output"] = *row.output_rate;
  return record;
}

std::vector<render::Chart> speed_figure(const std::vector<SpeedRow>& rows) {
  std::vector<render::Chart> panels;
  for (const int dimension : {2, 3})
    if (std::ranges::find(rows, dimension, &SpeedRow::dimension) != rows.end())
      panels.push_back(log_log(panel(rows, dimension)));
  return panels;
}

void write_speed(const std::filesystem::path& out, const SpeedReport& report) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const SpeedRow& row : report.rows) rows.push_back(to_json(row));
  io::write_json(out / "speed.json", rows);
  io::write_atomically(out / "speed.csv", csv_of(report.rows));

  nlohmann::ordered_json machine = to_json(report.machine);
  machine["skipped"] = report.skipped;
  machine["ratios"] = nlohmann::ordered_json::array();
  for (const SpeedRatio& ratio : speed_ratios(report.rows))
    machine["ratios"].push_back(to_json(ratio));
  io::write_json(out / "machine.json", machine);

  const std::vector<render::Chart> figure = speed_figure(report.rows);
  if (figure.empty()) return;
  render::write_png(
      out / "speed.png",
      render::render_chart_panels(
          figure, {.columns = 2, .letters = figure.size() > 1, .shared_legend = true}));
}

} // namespace scarp::bench
