#include "apps/bench/speed.hpp"

#include "apps/bench/flops.hpp"
#include "io/run_recorder.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include <time.h>

namespace scarp::bench {

namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// s, that this thread has had: others may still spin where they have waited for the last
/// repetition.
double processor_seconds() {
  timespec time = {};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Adds up the time between the ends of phases.
class PhaseClock final : public PhaseWatch {
 public:
  explicit PhaseClock(Simulation& simulation) : simulation_(simulation) {
    simulation_.watch(this);
    last_ = start_ = Clock::now();
  }
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;
  ~PhaseClock() override { simulation_.watch(nullptr); }

  void end_of(Phase phase) override {
    const Clock::time_point now = Clock::now();
    taken_[static_cast<std::size_t>(phase)] += seconds(now - last_);
    last_ = now;
  }

  Clock::time_point start() const { return start_; }

  /// s, since the start
  const std::array<double, phase_count>& taken() const { return taken_; }

 private:
  Simulation& simulation_;
  std::array<double, phase_count> taken_ = {};
  Clock::time_point start_, last_;
};

class KeptThreads {
 public:
  KeptThreads() = default;
  KeptThreads(const KeptThreads&) = delete;
  KeptThreads& operator=(const KeptThreads&) = delete;
  ~KeptThreads() { omp_set_num_threads(before_); }

 private:
  int before_ = omp_get_max_threads();
};

void advance(Simulation& simulation, long steps) {
  for (long k = 0; k < steps; ++k) simulation.step(std::numeric_limits<double>::infinity());
}

/// What one method with one number of threads took, repetition by repetition; s a step.
struct Times {
  std::vector<double> step;
  std::vector<double> processor; ///< of the first thread
  std::array<std::vector<double>, phase_count> phase;
};

void measure(Simulation& simulation, long steps, int threads, Times& times) {
  omp_set_num_threads(threads);
  const double processor_start = processor_seconds();
  const PhaseClock clock(simulation);
  advance(simulation, steps);
  const Clock::time_point end = Clock::now();
  const auto n = static_cast<double>(steps);
  times.step.push_back(seconds(end - clock.start()) / n);
  times.processor.push_back((processor_seconds() - processor_start) / n);
  for (std::size_t k = 0; k < phase_count; ++k) times.phase[k].push_back(clock.taken()[k] / n);
}

/// s, of one frame as a run writes it.
double measure_frame(const Simulation& simulation, const Scene& scene, int threads,
                     const std::filesystem::path& out) {
  omp_set_num_threads(threads);
  const std::filesystem::path directory = out / "frame_for_timing";
  const Clock::time_point start = Clock::now();
  io::SeriesWriter(directory, "frame").write(io::frame_of(simulation, scene));
  const double taken = seconds(Clock::now() - start);
  std::filesystem::remove_all(directory);
  return taken;
}

/// B a point for a size that has not been tried: the most of a smaller one of this dimension.
double expected_memory(const std::vector<SpeedRow>& rows, int dimension) {
  constexpr double first_guess = 1000.0; // B a point: only the smallest sizes rely on it
  double most = 0.0;
  for (const SpeedRow& row : rows)
    if (row.dimension == dimension) most = std::max(most, row.memory);
  return most > 0.0 ? most : first_guess;
}

/// One size with the methods that take part.
class Round {
 public:
  Round(const SpeedPlan& plan, const SpeedSize& size, const Machine& machine,
        std::vector<const SpeedMethod*> methods)
      : plan_(plan), size_(size), machine_(machine), methods_(std::move(methods)) {}

  void prepare(const SpeedProgress& progress) {
    omp_set_num_threads(plan_.threads.back());
    const Snapshot start = collapse_start(size_.size);
    for (const SpeedMethod* method : methods_) {
      progress.at(fmt::format("{} points, {}: first steps", size_.size.points(), method->name()));
      simulations_.push_back(begin_collapse(size_.size, method->method, start));
      advance(*simulations_.back(), size_.warm_up);
    }
  }

  void run(const SpeedProgress& progress) {
    times_.resize(methods_.size() * plan_.threads.size());
    for (int repetition = 0; repetition < size_.repetitions; ++repetition) {
      progress.at(fmt::format("{} points: repetition {} of {}", size_.size.points(), repetition + 1,
                              size_.repetitions));
      for (std::size_t m = 0; m < methods_.size(); ++m)
        for (std::size_t t = 0; t < plan_.threads.size(); ++t)
          measure(*simulations_[m], size_.steps, plan_.threads[t],
                  times_[m * plan_.threads.size() + t]);
    }
  }

  /// By number of threads; the columns are the same whatever the method.
  std::vector<std::optional<double>> frames(const SpeedProgress& progress,
                                            const std::filesystem::path& out) const {
    std::vector<std::optional<double>> rates(plan_.threads.size());
    const auto points = static_cast<double>(size_.size.points());
    if (points > plan_.largest_frame) return rates;
    progress.at(fmt::format("{} points: a frame", size_.size.points()));
    const Scene scene = collapse_scene(size_.size, methods_.front()->method);
    for (std::size_t t = 0; t < rates.size(); ++t)
      rates[t] = points / measure_frame(*simulations_.front(), scene, plan_.threads[t], out);
    return rates;
  }

  SpeedRow row(std::size_t m, std::size_t t) const {
    const Times& times = times_[m * plan_.threads.size() + t];
    const Simulation& simulation = *simulations_[m];
    const auto points = static_cast<double>(simulation.points());
    const double step = median(times.step);
    SpeedRow row;
    row.dimension = size_.size.dimension;
    row.how = *methods_[m];
    row.threads = plan_.threads[t];
    row.points = simulation.points();
    row.rate = points / step;
    const auto [least, most] = std::ranges::minmax(times.step);
    row.alone = points / (row.threads == 1 ? median(times.processor) : least);
    row.spread = (most - least) / step;
    for (std::size_t k = 0; k < phase_count; ++k) {
      const double taken = median(times.phase[k]);
      row.phase_rate[k] = taken > 0.0 ? points / taken : 0.0;
    }
    row.memory = static_cast<double>(simulation.memory()) / points;
    row.yielded = yielded_part(simulation);

    const Method& method = row.how.method;
    const StepCost cost = step_cost(row.dimension, method.shape, method.transfer,
                                    Grid{}.points_per_cell, row.how.number_size());
    row.flops = cost.all_flops();
    row.bytes = cost.all_bytes();
    const Roofline& roofline = machine_.rooflines.at(t);
    const double peak =
        row.how.number_size() == sizeof(float) ? roofline.flops_single : roofline.flops_double;
    row.part_of_flops = row.flops * row.rate / peak;
    row.part_of_bandwidth = row.bytes * row.rate / roofline.memory_bandwidth;
    return row;
  }

  std::size_t methods() const { return methods_.size(); }

 private:
  const SpeedPlan& plan_;
  const SpeedSize& size_;
  const Machine& machine_;
  std::vector<const SpeedMethod*> methods_;
  std::vector<std::unique_ptr<Simulation>> simulations_;
  std::vector<Times> times_;
};

/// Those that take part at a size; adds to `skipped` why others do not.
std::vector<const SpeedMethod*> taking_part(const SpeedPlan& plan, const CollapseSize& size,
                                            std::vector<std::string>& skipped) {
  std::vector<const SpeedMethod*> methods;
  for (const SpeedMethod& method : plan.methods) {
    if (static_cast<double>(size.points()) <= method.most_points[size.dimension == 2 ? 0 : 1])
      methods.push_back(&method);
    else
      skipped.push_back(fmt::format("{}-D, {}, {} points: would take too long", size.dimension,
                                    method.name(), size.points()));
  }
  return methods;
}

} // namespace

SpeedReport measure_speed(const SpeedPlan& plan, const std::filesystem::path& out,
                          const SpeedProgress& progress) {
  const KeptThreads kept;
  SpeedReport report;
  report.machine = this_machine();
  for (const int threads : plan.threads) {
    progress.at(fmt::format("what the machine can do, {} thread(s)", threads));
    report.machine.rooflines.push_back(
        measure_roofline(threads, report.machine, plan.rough_roofline));
  }
  progress.machine(report.machine);

  for (const SpeedSize& size : plan.sizes) {
    Round round(plan, size, report.machine, taking_part(plan, size.size, report.skipped));
    if (round.methods() == 0) continue;
    // All methods at once, and the state they begin from, with a fifth to spare.
    constexpr double start_state = 28.0 * sizeof(double); // B a point
    constexpr double to_spare = 1.2;
    const double needed = to_spare * static_cast<double>(size.size.points()) *
                          (start_state + expected_memory(report.rows, size.size.dimension) *
                                             static_cast<double>(round.methods()));
    const auto free = static_cast<double>(free_memory());
    if (free > 0.0 && needed > free) {
      report.skipped.push_back(
          fmt::format("{}-D, {} points: needs about {:.1f} GiB, {:.1f} are free",
                      size.size.dimension, size.size.points(), needed / 0x1p30, free / 0x1p30));
      continue;
    }
    round.prepare(progress);
    round.run(progress);
    const auto frames = round.frames(progress, out);
    for (std::size_t m = 0; m < round.methods(); ++m)
      for (std::size_t t = 0; t < plan.threads.size(); ++t) {
        report.rows.push_back(round.row(m, t));
        report.rows.back().output_rate = frames[t];
        progress.row(report.rows.back());
      }
  }
  return report;
}

} // namespace scarp::bench
