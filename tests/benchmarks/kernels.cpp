// Speed of the passes of a step and of a whole step, on a block of 12 800 points that has begun to
// collapse.  items_per_second is points per second.  The threads are OpenMP's (OMP_NUM_THREADS);
// real time is measured, not the processor time of one of them.
#include "core/contact_pass.hpp"
#include "core/gather_pass.hpp"
#include "core/lattice.hpp"
#include "core/move_pass.hpp"
#include "core/node_pass.hpp"
#include "core/scatter_pass.hpp"
#include "core/simulation.hpp"
#include "core/spline_shape.hpp"
#include "core/stress_pass.hpp"
#include "core/walls.hpp"
#include "tests/support/rows.hpp"
#include "tests/support/scenes.hpp"

#include <benchmark/benchmark.h>

#include <limits>
#include <memory>
#include <string>

namespace {

using namespace scarp;

constexpr std::size_t block_points = 12800;
constexpr Real flip = 0.999;

/// Cells of 5 mm; 160 x 80 points in plane strain, 40 x 16 x 20 in 3-D.
template <int Dim> Scene block() {
  constexpr double cell = 0.005;
  const std::array<double, 2> lower = {0.0, 0.0};
  Scene scene;
  if constexpr (Dim == 2) {
    scene.grid = test::grid_2d(cell, lower, {0.8, 0.4});
    scene.regions = {test::box("block", "rods", lower, {0.4, 0.2})};
  } else {
    scene.grid = test::grid_3d(cell, {0.0, 0.0, 0.0}, {0.2, 0.04, 0.1});
    scene.regions = {test::box("block", "rods", lower, {0.1, 0.05}, {0, 0, 0}, {0.0, 0.04})};
    for (Wall& side : scene.grid.walls[1]) side.kind = WallKind::symmetry;
  }
  scene.grid.walls[0][0].kind = WallKind::symmetry;
  scene.grid.walls[2][0].kind = WallKind::fixed;
  scene.method.flip = flip;
  scene.materials = {test::rods()};
  std::get<DruckerPrager>(scene.materials.front().law).opening = Opening::remembered;
  return scene;
}

template <class Shape> Scene with_shape(Scene scene) {
  scene.method.shape =
      Shape::layout == NodeLayout::spline ? ShapeFunctions::bspline : ShapeFunctions::linear;
  return scene;
}

/// The passes on a state of their own, which a Simulation does not give away.
template <int Dim, class Shape> struct Passes {
  Scene scene = block<Dim>();
  State<Dim, Shape> state{scene.grid, fill_regions<Dim>(scene), true};
  Walls<Dim> walls{scene, state.grid};
  ElasticModuli moduli = ElasticModuli::from(scene.materials.front().youngs_modulus,
                                             scene.materials.front().poissons_ratio);
  DruckerPragerUpdate law =
      DruckerPragerUpdate::from(std::get<DruckerPrager>(scene.materials.front().law), moduli);
  Real dt = make_simulation(with_shape<Shape>(scene))->stable_time_step();
  Vec<Dim> gravity = {};

  /// Until the block has begun to yield: the law's branches are those of a collapse.
  Passes() {
    gravity.back() = -9.81;
    walls.open_gates(0.0);
    for (int step = 0; step < 200; ++step) {
      state.order.update(state.particles);
      find_contacts_pass(state, 9.81, dt);
      scatter();
      gather_momentum_pass(state, walls);
      advance_momentum_pass(state, walls, gravity, 0.0, dt);
      gather_and_remap();
      remap_velocity_pass(state, walls, dt);
      update_stress();
      move_pass(state, dt, [](std::size_t) {});
    }
    state.order.update(state.particles);
  }
  void scatter() { scatter_pass<Dim, Terms::all>(state); }
  void gather_and_remap() { benchmark::DoNotOptimize(gather_pass<Dim, true>(state, flip)); }
  void update_stress() { stress_pass<Dim>(state, 0, moduli, law, true, dt); }
};

/// Measures one pass, again and again on the same block.
template <class AllPasses, void (AllPasses::*pass)()> void pass_of(benchmark::State& loop) {
  const auto passes = std::make_unique<AllPasses>();
  if (test::rows_of(passes->state.particles).size() != block_points)
    loop.SkipWithError("not 12 800 points");
  for (auto _ : loop) {
    ((*passes).*pass)();
    benchmark::ClobberMemory();
  }
  loop.SetItemsProcessed(loop.iterations() * static_cast<std::int64_t>(block_points));
}

/// Whole steps of a collapse that has begun; each measured step is another one.
template <int Dim, class Shape> void whole_step(benchmark::State& loop) {
  const std::unique_ptr<Simulation> simulation = make_simulation(with_shape<Shape>(block<Dim>()));
  if (simulation->points() != block_points) loop.SkipWithError("not 12 800 points");
  test::run_until(*simulation, 0.01);
  for (auto _ : loop) {
    simulation->step(std::numeric_limits<double>::infinity());
    // Before the front comes to the end of the grid.
    if (simulation->front() > 0.9 * (Dim == 2 ? 0.8 : 0.2)) {
      loop.SkipWithError("the block has come to the end of its grid; measure for less time");
      break;
    }
  }
  loop.SetItemsProcessed(loop.iterations() * static_cast<std::int64_t>(block_points));
}

template <int Dim, class Shape> void add(const std::string& name) {
  using All = Passes<Dim, Shape>;
  const auto with = [&](const char* pass, void (*run)(benchmark::State&)) {
    return benchmark::RegisterBenchmark((pass + ("/" + name)).c_str(), run)->UseRealTime();
  };
  with("scatter", pass_of<All, &All::scatter>);
  with("gather_and_remap", pass_of<All, &All::gather_and_remap>);
  with("stress", pass_of<All, &All::update_stress>);
  with("step", whole_step<Dim, Shape>)->Iterations(1000);
}

} // namespace

int main(int argc, char** argv) {
  add<2, LinearShape<2>>("2-D");
  add<3, LinearShape<3>>("3-D");
  add<2, SplineShape<2>>("2-D/bspline");
  add<3, SplineShape<3>>("3-D/bspline");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
