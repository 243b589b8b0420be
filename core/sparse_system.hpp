// Symmetric sparse linear equations, made once and solved for many right sides.
#pragma once

#include "core/types.hpp"

#include <memory>
#include <vector>

namespace scarp {

/// K q = f with K positive definite, or semidefinite through mechanisms that no f drives.
///
/// Solved is K with its diagonal 1 + 1e-10 times as large, which bounds the part of q in such a
/// mechanism, and by conjugate gradients to 1e-4 of f: who needs more solves again for the
/// residual.
class SparseSystem {
 public:
  /// factors: K = L D L^T, at once for every further f; of a body in space they fill up, with n
  /// unknowns to the order of n^(4/3).  gradients: conjugate ones, with an incomplete
  /// factorisation.
  enum class Solver { factors, gradients };

  SparseSystem(int unknowns, Solver solver);
  ~SparseSystem();
  SparseSystem(const SparseSystem&) = delete;
  SparseSystem& operator=(const SparseSystem&) = delete;

  int unknowns() const;

  /// K[row][column] += value; of K the lower triangle alone is kept, the rest is left out.
  void add(int row, int column, Real value);

  /// After the last add.
  void prepare();

  /// The best there is, if K has no inverse and f is not what it can balance.
  std::vector<Real> solve(const std::vector<Real>& right_side) const;

 private:
  struct Matrix;
  std::unique_ptr<Matrix> matrix_;
};

} // namespace scarp
