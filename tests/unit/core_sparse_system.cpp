#include "core/sparse_system.hpp"

#include <gtest/gtest.h>

using namespace scarp;

/// A chain of springs from a wall: K = tridiagonal(-1, 2, -1) with 1 at the end, so a pull f at the
/// end moves unknown i by (i + 1) f.  Beside it an unknown that nothing depends on.
TEST(SparseSystem, SolvesAChainOfSprings) {
  constexpr int springs = 20;
  for (const auto solver : {SparseSystem::Solver::factors, SparseSystem::Solver::gradients}) {
    SparseSystem K(springs + 1, solver);
    for (int i = 0; i < springs; ++i) {
      K.add(i, i, 1.0);
      if (i == 0) continue;
      K.add(i - 1, i - 1, 1.0);
      K.add(i, i - 1, -1.0);
      K.add(i - 1, i, -1.0); // the same entry, seen from the other side
    }
    K.prepare();
    std::vector<Real> f(springs + 1, 0.0);
    f[springs - 1] = 3.0;
    const std::vector<Real> q = K.solve(f);
    ASSERT_EQ(q.size(), f.size());
    for (int i = 0; i < springs; ++i)
      EXPECT_NEAR(q[static_cast<std::size_t>(i)], 3.0 * (i + 1), 1e-3 * 3.0 * springs);
    EXPECT_EQ(q[springs], 0.0);
  }
}
