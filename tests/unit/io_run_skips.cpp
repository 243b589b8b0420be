// What a run leaves out because the scene does not need it: that it is left out, that the plan says
// so, and that the rest is the same to the bit.  Frames cut the steps to their times, so runs are
// compared at the same output interval.
#include "io/run_recorder.hpp"
#include "io_files.hpp"
#include "tests/support/scenes.hpp"

#include <map>
#include <memory>

using namespace scarp;
using namespace scarp::test;

namespace {

/// Passes everything on, and counts what costs a sweep over the points.
class Counted final : public Simulation {
 public:
  explicit Counted(const Scene& scene) : inner_(make_simulation(scene)) {}

  double step(double until) override { return inner_->step(until); }
  int dimension() const override { return inner_->dimension(); }
  double time() const override { return inner_->time(); }
  long steps() const override { return inner_->steps(); }
  std::size_t points() const override { return inner_->points(); }
  std::size_t memory() const override { return inner_->memory(); }
  std::size_t cells() const override { return inner_->cells(); }
  std::size_t occupied_cells() const override { return inner_->occupied_cells(); }
  bool waits_for_gate() const override { return inner_->waits_for_gate(); }
  const Stage& stage() const override { return inner_->stage(); }
  double stage_end() const override { return inner_->stage_end(); }
  bool in_last_stage() const override { return inner_->in_last_stage(); }
  void next_stage() override { inner_->next_stage(); }
  double stable_time_step() const override { return inner_->stable_time_step(); }
  double front() const override { return count("front"), inner_->front(); }
  Energies energies() const override { return count("energies"), inner_->energies(); }
  std::vector<PlanLine> plan() const override { return inner_->plan(); }
  std::vector<double> positions() const override { return count("positions"), inner_->positions(); }
  std::vector<double> field(const std::string& name) const override {
    return count(name), inner_->field(name);
  }
  std::size_t nearest_point(const std::array<double, 3>& place) const override {
    return inner_->nearest_point(place);
  }

  const std::map<std::string, int>& counts() const { return counts_; }

 private:
  void count(const std::string& what) const { ++counts_[what]; }

  std::unique_ptr<Simulation> inner_;
  mutable std::map<std::string, int> counts_;
};

/// Six frames and eleven rows.
Scene short_run(const std::vector<std::string>& fields) {
  Scene scene = pile(0.04, 0.02, 0.005, 0.12, 0.04);
  scene.timing.end_time = 0.0125;
  scene.timing.output_interval = 0.0025;
  scene.timing.history_interval = 0.00125;
  scene.output.fields = fields;
  return scene;
}

struct State {
  double time;
  long steps;
  std::vector<std::vector<double>> values;
  bool operator==(const State&) const = default;
};

State state_of(const Simulation& simulation) {
  State state{simulation.time(), simulation.steps(), {simulation.positions()}};
  for (const char* name : {"velocity", "stress", "equivalent_plastic_strain", "volume", "gap"})
    state.values.push_back(simulation.field(name));
  return state;
}

/// Of the simulation after a run that wrote to the directory.
State run_recorded(const Scene& scene, const fs::path& directory) {
  const auto simulation = make_simulation(scene);
  io::RunRecorder recorder(scene, *simulation, directory, "pile", 1);
  recorder.finish(*simulation, run(*simulation, scene.timing, recorder), "");
  return state_of(*simulation);
}

std::string line(const Scene& scene, const std::string& what) {
  const auto simulation = make_simulation(scene);
  const io::RunRecorder recorder(scene, *simulation, fresh_directory(), "pile", 1);
  for (const PlanLine& line : recorder.plan())
    if (line.what == what) return line.how;
  return "no such line";
}

} // namespace

TEST(RunSkips, FieldsThatAreNotWrittenAndEnergiesThatAreNotDue) {
  const Scene scene = short_run({"velocity", "volume"});
  Counted simulation(scene);
  {
    io::RunRecorder recorder(scene, simulation, fresh_directory(), "pile", 1);
    run(simulation, scene.timing, recorder);
  }
  EXPECT_GT(simulation.steps(), 22);
  EXPECT_EQ(
      simulation.counts(),
      (std::map<std::string, int>{
          {"positions", 6}, {"velocity", 6}, {"volume", 6}, {"energies", 11}, {"front", 11}}));
}

/// With a monitor, its rows take positions and velocities: of points that nobody follows, none.
TEST(RunSkips, MonitorsThatThereAreNot) {
  Scene scene = short_run({"region"});
  scene.monitors.push_back({"toe", {0.04, 0.0, 0.0}});
  Counted simulation(scene);
  {
    io::RunRecorder recorder(scene, simulation, fresh_directory(), "pile", 1);
    run(simulation, scene.timing, recorder);
  }
  EXPECT_EQ(simulation.counts(), (std::map<std::string, int>{{"positions", 6 + 11},
                                                             {"velocity", 11},
                                                             {"region", 6},
                                                             {"energies", 11},
                                                             {"front", 11}}));
}

TEST(RunSkips, LeaveTheRestTheSameToTheBit) {
  const fs::path directory = fresh_directory();
  const State all = run_recorded(short_run({}), directory / "all");
  const State few = run_recorded(short_run({"velocity"}), directory / "few");
  EXPECT_TRUE(few == all);
  EXPECT_TRUE(content(directory / "all/history.csv") == content(directory / "few/history.csv"));
  EXPECT_TRUE(content(directory / "all/pile.pvd") == content(directory / "few/pile.pvd"));
  const io::SeriesReader all_frames(directory / "all");
  const io::SeriesReader few_frames(directory / "few");
  for (std::size_t i = 0; i < 6; ++i) {
    const io::Frame frame = few_frames.read(i);
    EXPECT_EQ(frame.columns.size(), 1U);
    EXPECT_EQ(frame.position, all_frames.read(i).position);
    EXPECT_EQ(frame.column("velocity").values, all_frames.read(i).column("velocity").values);
  }

  // A row at every step, and none but the first and the last.
  for (const double interval : {1e-6, 0.0125}) {
    Scene scene = short_run({"velocity"});
    scene.timing.history_interval = interval;
    const fs::path where = directory / std::to_string(interval);
    EXPECT_TRUE(run_recorded(scene, where) == all);
    EXPECT_TRUE(content(where / "pile_000005.vtp") == content(directory / "few/pile_000005.vtp"));
  }

  // No observer at all.
  const Scene scene = short_run({});
  const auto simulation = make_simulation(scene);
  Observer nobody;
  run(*simulation, scene.timing, nobody);
  EXPECT_TRUE(state_of(*simulation) == all);
}

namespace {

struct Enough {};

/// Ends a run after so many steps.
struct StopAfter : Observer {
  explicit StopAfter(long its_steps) : steps(its_steps) {}
  void progress(const Simulation& simulation) override {
    if (simulation.steps() == steps) throw Enough();
  }
  long steps;
};

} // namespace

/// A run that ends at rest is the run to the end time, cut short.
TEST(RunSkips, TheTimeAfterRest) {
  Scene scene = short_run({});
  scene.method.local_damping = 0.5;
  scene.timing.end_time = 2.0;
  scene.timing.output_interval = 0.1;
  scene.timing.rest_energy_fraction = 0.1;
  scene.timing.rest_duration = 0.005;
  const auto resting = make_simulation(scene);
  Observer nobody;
  ASSERT_EQ(run(*resting, scene.timing, nobody).reason, StopReason::at_rest);
  EXPECT_LT(resting->time(), 1.0);

  scene.timing.rest_energy_fraction = 0.0;
  const auto going_on = make_simulation(scene);
  StopAfter stop(resting->steps());
  EXPECT_THROW(run(*going_on, scene.timing, stop), Enough);
  EXPECT_TRUE(state_of(*going_on) == state_of(*resting));
}

TEST(RunSkips, AreInThePlan) {
  Scene scene = short_run({});
  EXPECT_EQ(line(scene, "frames"), "every 0.0025 s, to which steps are cut; written by another "
                                   "thread, from at most 3 copies");
  EXPECT_EQ(line(scene, "fields"), "all 12");
  EXPECT_EQ(line(scene, "history"), "energies and front every 0.00125 s, at the first step from "
                                    "then on; skipped in between");
  EXPECT_EQ(line(scene, "monitors"), "none, skipped");
  EXPECT_EQ(line(scene, "end"), "at 0.0125 s; rest is not looked for");
  scene.output.fields = {"velocity", "gap"};
  scene.timing.history_interval = 0.0;
  scene.monitors = {{"toe", {0.04, 0, 0}}, {"top", {0, 0, 0.02}}};
  scene.timing.rest_energy_fraction = 1e-3;
  scene.timing.rest_duration = 0.01;
  EXPECT_EQ(line(scene, "fields"), "velocity, gap; the other 10 skipped");
  EXPECT_EQ(line(scene, "history").find("energies and front every 0.00025 s"), 0U);
  EXPECT_EQ(line(scene, "monitors"), "toe, top");
  EXPECT_EQ(line(scene, "end"), "at rest (grid's kinetic energy below 0.001 of its peak for "
                                "0.01 s), else at 0.0125 s");
}
