// Symmetric sparse linear equations, factorised once and solved for many right sides.
#pragma once

#include "core/types.hpp"

#include <memory>
#include <vector>

namespace scarp {

/// K q = f with K positive definite or, through mechanisms that no load drives, semidefinite.
/// Factorised is K with its diagonal 1 + 1e-10 times as large, which bounds what those mechanisms
/// get; the residual of the true K is left to whoever solves again for it.  A factor of the error
/// of that order is left each time, over the mode's stiffness relative to the diagonal.
class SparseSystem {
 public:
  explicit SparseSystem(int unknowns);
  ~SparseSystem();
  SparseSystem(const SparseSystem&) = delete;
  SparseSystem& operator=(const SparseSystem&) = delete;

  int unknowns() const;

  /// K[row][column] += value; of K the lower triangle alone is kept, the rest is left out.
  void add(int row, int column, Real value);

  /// After the last add.
  void factorise();

  std::vector<Real> solve(const std::vector<Real>& right_side) const;

 private:
  struct Matrix;
  std::unique_ptr<Matrix> matrix_;
};

} // namespace scarp
