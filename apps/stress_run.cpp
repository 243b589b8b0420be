#include "apps/stress_run.hpp"

#include "core/run.hpp"

#include <omp.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace scarp::apps {

namespace {

/// Ends a run at its first failure.
struct Stop {
  StressFailure failure;
};

class Watch final : public Observer {
 public:
  Watch(const StressLimits& limits, double cell_size) : checks_(limits), h_(cell_size) {}

  void frame(const Simulation& simulation) override { look(simulation); }
  void progress(const Simulation& simulation) override {
    checks_.put_in(simulation.energies());
    if (before_) {
      const double loss = centred_loss(*before_, simulation.field("velocity"),
                                       simulation.field("velocity_gradient"), h_);
      stop_at(checks_.look_at_energy(*before_, loss));
      before_.reset();
    }
    if (simulation.steps() % steps_between_looks == 0) look(simulation);
  }
  const StressChecks& checks() const { return checks_; }

 private:
  void look(const Simulation& simulation) {
    if (simulation.steps() == looked_at_) return;
    looked_at_ = simulation.steps();
    before_ = stress_moment(simulation);
    stop_at(checks_.look(*before_));
  }
  static void stop_at(const std::optional<StressFailure>& failure) {
    if (failure) throw Stop{*failure};
  }

  StressChecks checks_;
  double h_;                           ///< m
  std::optional<StressMoment> before_; ///< the last look; its energy is looked at a step later
  long looked_at_ = -1;
};

void watch(const Scene& scene, Simulation& simulation, StressResult& result) {
  Watch watch(stress_limits(scene), scene.grid.cell_size);
  try {
    run(simulation, scene.timing, watch);
  } catch (const Stop& stop) {
    result.failure = stop.failure;
  } catch (const RunError& error) {
    result.message = error.what();
    result.failure = explain(error, scene, stress_moment(simulation));
    if (!result.failure) result.end = StressEnd::left_grid;
  }
  if (result.failure) result.end = StressEnd::failed;
  result.points = simulation.points();
  result.steps = simulation.steps();
  result.nearest = watch.checks().nearest();
}

} // namespace

StressResult run_stress_scene(const StressScene& stress) {
  StressResult result;
  result.number = stress.number;
  result.family = stress.family;
  std::unique_ptr<Simulation> simulation;
  try {
    simulation = make_simulation(stress.scene);
  } catch (const SetupError& error) {
    result.end = StressEnd::refused;
    result.message = error.what();
    return result;
  }
  watch(stress.scene, *simulation, result);
  return result;
}

std::vector<StressResult> run_stress_scenes(Preset preset, std::uint64_t seed, std::size_t count,
                                            int jobs,
                                            const std::function<void(const StressResult&)>& done) {
  std::vector<StressResult> results(count);
  std::atomic<std::size_t> next = 0;
  std::mutex one_at_a_time;
  std::exception_ptr error;
  const auto work = [&] {
    omp_set_num_threads(1); // of this thread's parallel regions
    try {
      for (std::size_t k = next++; k < count; k = next++) {
        results[k] = run_stress_scene(stress_scene(preset, seed, k));
        const std::lock_guard lock(one_at_a_time);
        done(results[k]);
      }
    } catch (...) {
      const std::lock_guard lock(one_at_a_time);
      error = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(jobs));
  for (int job = 0; job < jobs; ++job) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
  return results;
}

} // namespace scarp::apps
