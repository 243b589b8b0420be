// What the solver's plan says is skipped: with it, as weak as can be, everything is the same to the
// bit.  Fields, frames and rows: io_run_skips.cpp; the third dimension: core_simulation.cpp; the
// return of points that stay elastic: core_stress.cpp.
#include "core/simulation.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

using namespace scarp;
using namespace scarp::test;

namespace {

using Fields = std::map<std::string, std::vector<double>>;

/// After 60 steps of a pile that has begun to slide.
Fields run(const Scene& scene) {
  const auto simulation = make_simulation(scene);
  for (int k = 0; k < 60; ++k) simulation->step(1.0);
  Fields fields = {{"position", simulation->positions()}};
  for (const char* name : {"velocity", "stress", "volume", "equivalent_plastic_strain"})
    fields[name] = simulation->field(name);
  return fields;
}

std::string line(const Scene& scene, const std::string& what) {
  const auto lines = make_simulation(scene)->plan();
  const auto found = std::ranges::find_if(lines, [&](const PlanLine& l) { return l.what == what; });
  return found == lines.end() ? "" : found->how;
}

/// The plan says that `what` is skipped, and no more so once it is there; results do not change.
void expect_skipped(const std::string& what, const std::function<void(Scene&)>& put_in) {
  for (const auto& [shape, transfer] :
       {std::pair{ShapeFunctions::linear, VelocityTransfer::flip},
        std::pair{ShapeFunctions::bspline, VelocityTransfer::apic}}) {
    Scene without = pile(0.08, 0.04, 0.01, 0.4, 0.1);
    without.method.shape = shape;
    without.method.transfer = transfer;
    Scene with = without;
    put_in(with);
    EXPECT_NE(line(without, what).find("skipped"), std::string::npos) << line(without, what);
    EXPECT_EQ(line(with, what).find("skipped"), std::string::npos) << line(with, what);
    EXPECT_EQ(run(without), run(with)) << what;
  }
}

} // namespace

/// A force that is lost in the rounding of any other.
TEST(Plan, SkipsDamping) {
  expect_skipped("local damping", [](Scene& scene) { scene.method.local_damping = 1e-300; });
}

/// At a side that nothing reaches.
TEST(Plan, SkipsFrictionWalls) {
  expect_skipped("friction walls", [](Scene& scene) {
    scene.grid.walls[0][1] = {WallKind::friction, 0.5};
  });
}

/// On a plane that nothing reaches; it is still closed, so steps are not cut for it.
TEST(Plan, SkipsGates) {
  expect_skipped("gates", [](Scene& scene) { scene.gates = {{"gate", 0, 0.3, 10.0}}; });
}
