#include "core/sparse_system.hpp"

#include <Eigen/SparseCholesky>

#include <cstddef>
#include <stdexcept>

namespace scarp {

namespace {
constexpr Real shift = 1e-10;
constexpr std::size_t most_entries = std::size_t{1} << 22; // not yet added up: 64 MiB
} // namespace

struct SparseSystem::Matrix {
  using Sparse = Eigen::SparseMatrix<Real>;

  explicit Matrix(int unknowns) : lower(unknowns, unknowns) {}

  void add_up() {
    Sparse sum(lower.rows(), lower.cols());
    sum.setFromTriplets(entries.begin(), entries.end());
    lower += sum;
    entries.clear();
  }

  Sparse lower;
  std::vector<Eigen::Triplet<Real>> entries;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower> factors;
};

SparseSystem::SparseSystem(int unknowns) : matrix_(std::make_unique<Matrix>(unknowns)) {}
SparseSystem::~SparseSystem() = default;

int SparseSystem::unknowns() const { return static_cast<int>(matrix_->lower.rows()); }

void SparseSystem::add(int row, int column, Real value) {
  if (row < column) return;
  matrix_->entries.emplace_back(row, column, value);
  if (matrix_->entries.size() == most_entries) matrix_->add_up();
}

void SparseSystem::factorise() {
  matrix_->add_up();
  const Eigen::VectorXd diagonal = matrix_->lower.diagonal();
  for (int i = 0; i < unknowns(); ++i)
    // A 0 is an unknown that no strain depends on: any positive number holds it in its place.
    matrix_->lower.coeffRef(i, i) += diagonal[i] > 0.0 ? shift * diagonal[i] : diagonal.maxCoeff();
  matrix_->factors.compute(matrix_->lower);
  if (matrix_->factors.info() != Eigen::Success)
    throw std::runtime_error("SparseSystem: the matrix is not positive");
}

std::vector<Real> SparseSystem::solve(const std::vector<Real>& right_side) const {
  const Eigen::Map<const Eigen::VectorXd> f(right_side.data(), matrix_->lower.rows());
  const Eigen::VectorXd q = matrix_->factors.solve(f);
  return {q.begin(), q.end()};
}

} // namespace scarp
