#include "apps/bench/speed.hpp"

#include <fmt/format.h>

#include <cstdio>

#include <unistd.h>

namespace scarp::bench {

namespace {

/// One line on stderr, if that is a terminal, which the next one and the table overwrite.
class ProgressText {
 public:
  void show(const std::string& text) const {
    if (visible_) fmt::print(stderr, "\r\033[K{}", text);
  }

 private:
  bool visible_ = ::isatty(STDERR_FILENO) != 0;
};

void print(const Machine& machine) {
  fmt::print("{}, {} processor{}, load {:.1f}; {}, {} doubles in a register\n", machine.processor,
             machine.processors, machine.processors == 1 ? "" : "s", machine.load, machine.compiler,
             machine.lanes);
  for (const Roofline& one : machine.rooflines)
    fmt::print(
        "  peak, {} thread{}: {:.0f} GFLOP/s double, {:.0f} single; {:.1f} GB/s from memory, "
        "{:.0f} from cache\n",
        one.threads, one.threads == 1 ? " " : "s", one.flops_double / 1e9, one.flops_single / 1e9,
        one.memory_bandwidth / 1e9, one.cache_bandwidth / 1e9);
  if (machine.load + machine.rooflines.back().threads > machine.processors + 0.5)
    fmt::print(
        "  note: other programs are at work here; numbers are too low by what they take, those "
        "of several threads most\n");
  fmt::print("\nMillion point-steps/s, of the whole step and of each phase alone (frames: million "
             "points/s); medians.  alone: as if\nno other program ran "
             "(processor time, 2 threads: shortest repetition); spread: longest less shortest\n");
  fmt::print("{:>3} {:12} {:9} {:>7} {:>9} {:>7} {:>7} {:>6} {:>6} {:>6} {:>5} {:>5} {:>6}", "dim",
             "shape", "precision", "threads", "points", "rate", "alone", "spread", "peak", "band-",
             "flop/", "B/pt", "yields");
  for (const char* name : {"sort", "P2G", "grid", "G2P", "remap", "stress", "output"})
    fmt::print(" {:>6}", name);
  fmt::print("\n{:>79} {:>6} {:>5}\n", "FLOPS", "width", "step");
  std::fflush(stdout);
}

void print(const SpeedRow& row) {
  const auto percent = [](double part) { return fmt::format("{:.1f}%", 100.0 * part); };
  fmt::print(
      "{:>3} {:12} {:9} {:>7} {:>9} {:>7.2f} {:>7.2f} {:>6} {:>6} {:>6} {:>5.0f} {:>5.0f} {:>6}",
      row.dimension, row.how.name(), row.how.precision(), row.threads, row.points, row.rate / 1e6,
      row.alone / 1e6, percent(row.spread), percent(row.part_of_flops),
      percent(row.part_of_bandwidth), row.flops, row.memory, percent(row.yielded));
  for (const double rate : row.phase_rate) fmt::print(" {:>6.3g}", rate / 1e6);
  fmt::print(" {:>6}\n", row.output_rate ? fmt::format("{:.2g}", *row.output_rate / 1e6) : "-");
  std::fflush(stdout);
}

void print(const SpeedRatio& ratio) {
  const std::string bound =
      ratio.bound ? fmt::format("{} {:g}", ratio.kind == Bound::at_least ? "≥" : "≤", *ratio.bound)
                  : "";
  fmt::print("  {:6} {:60} {:>8.3g} {:>8.3g} {:21} {}\n", ratio.verdict(), ratio.name, ratio.value,
             ratio.alone, ratio.unit, bound);
}

} // namespace

void run_speed(const SpeedOptions& options) {
  const ProgressText progress;
  const SpeedReport report =
      measure_speed(speed_plan(options.quick ? Effort::quick : Effort::full), options.out,
                    {.at = [&](const std::string& what) { progress.show(what + " ..."); },
                     .machine =
                         [&](const Machine& machine) {
                           progress.show("");
                           print(machine);
                         },
                     .row =
                         [&](const SpeedRow& row) {
                           progress.show("");
                           print(row);
                         }});
  write_speed(options.out, report);
  fmt::print("\nRatios and bounds{:>60} {:>8}\n", "median", "alone");
  for (const SpeedRatio& ratio : speed_ratios(report.rows)) print(ratio);
  for (const std::string& what : report.skipped) fmt::print("left out: {}\n", what);
  fmt::print("{}\n", (options.out / "speed.json").string());
}

} // namespace scarp::bench
