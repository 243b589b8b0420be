#include "core/sparse_system.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <cstddef>
#include <stdexcept>

namespace scarp {

namespace {
constexpr Real shift = 1e-10;
constexpr Real tolerance = 1e-4;                           // of conjugate gradients
constexpr int most_steps = 2000;                           // of these
constexpr std::size_t most_entries = std::size_t{1} << 22; // not yet added up: 64 MiB
} // namespace

struct SparseSystem::Matrix {
  using Sparse = Eigen::SparseMatrix<Real>;

  Matrix(int unknowns, Solver chosen) : solver(chosen), lower(unknowns, unknowns) {
    gradients.setTolerance(tolerance);
    gradients.setMaxIterations(most_steps);
  }

  void add_up() {
    Sparse sum(lower.rows(), lower.cols());
    sum.setFromTriplets(entries.begin(), entries.end());
    lower += sum;
    entries.clear();
  }

  Solver solver;
  Sparse lower;
  std::vector<Eigen::Triplet<Real>> entries;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower> factors;
  Eigen::ConjugateGradient<Sparse, Eigen::Lower, Eigen::IncompleteCholesky<Real>> gradients;
};

SparseSystem::SparseSystem(int unknowns, Solver solver)
    : matrix_(std::make_unique<Matrix>(unknowns, solver)) {}
SparseSystem::~SparseSystem() = default;

int SparseSystem::unknowns() const { return static_cast<int>(matrix_->lower.rows()); }

void SparseSystem::add(int row, int column, Real value) {
  if (row < column) return;
  matrix_->entries.emplace_back(row, column, value);
  if (matrix_->entries.size() == most_entries) matrix_->add_up();
}

void SparseSystem::prepare() {
  matrix_->add_up();
  const Eigen::VectorXd diagonal = matrix_->lower.diagonal();
  for (int i = 0; i < unknowns(); ++i)
    // A 0 is an unknown that no strain depends on: any positive number holds it in its place.
    matrix_->lower.coeffRef(i, i) += diagonal[i] > 0.0 ? shift * diagonal[i] : diagonal.maxCoeff();
  const bool by_factors = matrix_->solver == Solver::factors;
  if (by_factors)
    matrix_->factors.compute(matrix_->lower);
  else
    matrix_->gradients.compute(matrix_->lower);
  if ((by_factors ? matrix_->factors.info() : matrix_->gradients.info()) != Eigen::Success)
    throw std::runtime_error("SparseSystem: the matrix is not positive");
}

std::vector<Real> SparseSystem::solve(const std::vector<Real>& right_side) const {
  const Eigen::Map<const Eigen::VectorXd> f(right_side.data(), matrix_->lower.rows());
  Eigen::VectorXd q;
  if (matrix_->solver == Solver::factors)
    q = matrix_->factors.solve(f);
  else
    q = matrix_->gradients.solve(f);
  return {q.begin(), q.end()};
}

} // namespace scarp
