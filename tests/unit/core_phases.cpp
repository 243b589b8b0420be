// What a simulation tells of its phases and its memory.
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <malloc.h>

#include <algorithm>
#include <vector>

using namespace scarp;
using namespace scarp::test;

namespace {

class Record final : public PhaseWatch {
 public:
  void end_of(Phase phase) override { phases.push_back(phase); }
  std::vector<Phase> phases;
};

Scene coarse_pile(Scheme scheme) {
  Scene scene = pile(0.2, 0.1, 0.01, 0.4, 0.15);
  scene.method.scheme = scheme;
  return scene;
}

std::size_t memory_of(double cell_size) {
  return make_simulation(pile(0.2, 0.1, cell_size, 0.4, 0.15))->memory();
}

} // namespace

TEST(Phases, AreToldOnceAStepInOrder) {
  using enum Phase;
  const auto simulation = make_simulation(coarse_pile(Scheme::musl));
  Record record;
  simulation->watch(&record);
  simulation->step(1.0);
  const std::vector<Phase> of_step = {sort, scatter, nodes, gather, remap, stress};
  EXPECT_EQ(record.phases, of_step);
  simulation->step(1.0);
  EXPECT_EQ(record.phases.size(), 2 * of_step.size());
  simulation->watch(nullptr);
  simulation->step(1.0);
  EXPECT_EQ(record.phases.size(), 2 * of_step.size());
}

TEST(Phases, OfAllSchemesEndWithTheMotion) {
  using enum Phase;
  for (const Scheme scheme : {Scheme::usf, Scheme::usl}) {
    const auto simulation = make_simulation(coarse_pile(scheme));
    Record record;
    simulation->watch(&record);
    simulation->step(1.0);
    ASSERT_FALSE(record.phases.empty());
    EXPECT_EQ(record.phases.front(), sort);
    EXPECT_EQ(record.phases.back(), stress);
    EXPECT_EQ(std::ranges::count(record.phases, remap), 0);
    EXPECT_EQ(std::ranges::count(record.phases, scatter), scheme == Scheme::usf ? 2 : 1);
  }
}

TEST(Phases, WatchingChangesNothing) {
  const auto watched = make_simulation(coarse_pile(Scheme::musl));
  const auto alone = make_simulation(coarse_pile(Scheme::musl));
  Record record;
  watched->watch(&record);
  for (int k = 0; k < 50; ++k) {
    watched->step(1.0);
    alone->step(1.0);
  }
  EXPECT_EQ(watched->positions(), alone->positions());
  EXPECT_EQ(watched->field("stress"), alone->field("stress"));
}

TEST(Memory, GrowsWithPointsAndCells) {
  const std::size_t coarse = memory_of(0.01), fine = memory_of(0.005);
  EXPECT_NEAR(static_cast<double>(fine) / static_cast<double>(coarse), 4.0, 0.6);
}

/// Against what the C library says that it has given out.
TEST(Memory, IsWhatIsAllocated) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer's own malloc does not count";
#endif
  const auto in_use = [] {
    const struct mallinfo2 all = mallinfo2();
    return static_cast<double>(all.uordblks + all.hblkhd);
  };
  const Scene scene = pile(0.2, 0.1, 0.001, 0.4, 0.15);
  const double before = in_use();
  const auto simulation = make_simulation(scene);
  simulation->step(1.0);
  const double taken = in_use() - before;
  EXPECT_NEAR(static_cast<double>(simulation->memory()), taken, 0.02 * taken);
}
