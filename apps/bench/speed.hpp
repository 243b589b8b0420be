// `scarp bench speed`: points times steps a second, phase by phase, beside what the machine can do.
#pragma once

#include "apps/bench/cases.hpp"
#include "apps/bench/collapse.hpp"
#include "apps/bench/report.hpp"
#include "apps/bench/roofline.hpp"
#include "core/phases.hpp"

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scarp::bench {

/// One way to compute, at all sizes and numbers of threads.
struct SpeedMethod {
  Method method;
  /// Larger sizes are left out, since they would take too long; in plane strain and in 3-D.
  std::array<double, 2> most_points = {1e300, 1e300};

  std::string precision() const;
  std::size_t number_size() const; ///< B
  std::string shape() const;
  std::string transfer() const;
  /// Such as "linear" or "bspline aflip".
  std::string name() const;
};

struct SpeedSize {
  CollapseSize size;
  long warm_up = 0;    ///< steps before the first measurement
  long steps = 0;      ///< of one measurement
  int repetitions = 0; ///< of each method with each number of threads
};

struct SpeedPlan {
  std::vector<SpeedMethod> methods;
  std::vector<SpeedSize> sizes; ///< those of a dimension ascend
  std::vector<int> threads;     ///< ascending, from 1
  double largest_frame = 0.0;   ///< points; larger ones are not written
  bool rough_roofline = false;
};

/// Full: 10^4 to 10^7 points in plane strain, to 10^6 in 3-D.  Quick: 10^5, under a minute.
SpeedPlan speed_plan(Effort effort);

/// One method at one size with one number of threads: medians of the repetitions.
struct SpeedRow {
  int dimension = 2;
  SpeedMethod how;
  int threads = 1;
  std::size_t points = 0;
  double rate = 0.0; ///< point-steps/s
  /// The same as if no other program ran: by the processor's time with one thread, of the shortest
  /// repetition with several.
  double alone = 0.0;
  double spread = 0.0; ///< longest less shortest repetition, part of the median
  std::array<double, phase_count> phase_rate = {}; ///< point-steps/s, of a phase on its own
  std::optional<double> output_rate;               ///< points/s into a frame on disk
  double memory = 0.0;                             ///< B a point
  double yielded = 0.0;                            ///< part of the points
  double flops = 0.0;                              ///< of a point-step
  double bytes = 0.0;                              ///< of a point-step, if no cache held anything
  double part_of_flops = 0.0;                      ///< of the machine's peak
  double part_of_bandwidth = 0.0;                  ///< of its memory's; caches may give more than 1
};

/// A number that follows from rows, and its bound if it has one.
struct SpeedRatio {
  std::string name;
  double value = 0.0;
  double alone = 0.0; ///< the same from SpeedRow::alone
  std::string unit;
  std::optional<double> bound = {};
  Bound kind = Bound::at_most; ///< or at_least

  /// Of `value`: "pass", "MISSED", or "-" without a bound.
  std::string verdict() const;
};

struct SpeedReport {
  Machine machine;
  std::vector<SpeedRow> rows;
  std::vector<std::string> skipped; ///< what was left out, and why
};

/// What a measurement tells while it goes on.
struct SpeedProgress {
  std::function<void(const std::string&)> at = [](const std::string&) {}; ///< what it does now
  std::function<void(const Machine&)> machine = [](const Machine&) {};
  std::function<void(const SpeedRow&)> row = [](const SpeedRow&) {};
};

/// Methods and numbers of threads take turns, so that what else the machine does hits all alike.
/// Writes frames under `out` and removes them.  Throws RunError if a run fails, std::runtime_error
/// if a frame cannot be written.  Leaves OpenMP's number of threads as it was.
SpeedReport measure_speed(const SpeedPlan& plan, const std::filesystem::path& out,
                          const SpeedProgress& progress);

/// Of the rows that are there, at the sizes that are nearest to the bounds' ones.
std::vector<SpeedRatio> speed_ratios(const std::vector<SpeedRow>& rows);

/// Writes speed.json (a list, an entry a row), speed.csv (the same), machine.json, speed.png.
/// Throws std::runtime_error.
void write_speed(const std::filesystem::path& out, const SpeedReport& report);

nlohmann::ordered_json to_json(const SpeedRow& row);

/// Panels of point-steps/s (SpeedRow::alone) over points, a line a method and number of threads.
std::vector<render::Chart> speed_figure(const std::vector<SpeedRow>& rows);

struct SpeedOptions {
  std::filesystem::path out; ///< a directory that exists
  bool quick = false;
};

/// Measures, prints and writes everything.
void run_speed(const SpeedOptions& options);

} // namespace scarp::bench
