#include "coupling/eigensolvers/block_lanczos.h"

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Numbers in [-1, 1), always the same for a seed, on any number of processes.
MultiVector irregular(const InverseStiffness &of, int columns, unsigned long &seed)
{
  const int               rows = int(of.order().size());
  MultiVector             X(rows, columns);
  constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u; // SplitMix64: 2^64 over the golden ratio
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
    {
      std::uint64_t z = seed + (std::uint64_t(of.place(i)) * columns + j + 1) * golden;
      z               = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
      z               = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
      X(i, j)         = std::ldexp(double((z ^ (z >> 31)) >> 11), -52) - 1.;
    }
  seed += std::uint64_t(of.size()) * columns * golden;
  return X;
}

VectorXd norms(const MatrixXd &gram)
{
  return gram.diagonal().cwiseMax(0.).cwiseSqrt();
}

struct EigenPairs
{
  VectorXd lambda; // ascending
  MatrixXd vectors;
};

/// Eigenpairs of a symmetric matrix; the same on all processes, whose decisions depend on it.
EigenPairs eigen(const MatrixXd &A, const InverseStiffness &among)
{
  const SymmetricEigenSolver solved(A);
  MatrixXd                   both(A.rows(), A.rows() + 1);
  both << solved.eigenvalues(), solved.eigenvectors();
  among.share(both);
  return {both.col(0), both.rightCols(A.rows())};
}

std::vector<int> all_of(int n)
{
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

} // namespace

void InverseStiffness::solve_columns(Eigen::Ref<MatrixXd> X) const
{
  MultiVector block(int(X.rows()), int(X.cols()));
  block.take(X, order());
  solve_in_place(block);
  block.give(X, order());
}

InverseByColumns::InverseByColumns(int n, Solve solve, std::vector<int> held)
    : solve_(std::move(solve)), order_(all_of(n)), held_(std::move(held))
{
}

void InverseByColumns::solve_in_place(MultiVector &X) const
{
  MatrixXd columns(X.rows(), X.columns());
  X.give(columns, order_);
  solve_(columns);
  X.take(columns, order_);
}

BlockLanczos::BlockLanczos(const Eigen::SparseMatrix<double> &M, std::shared_ptr<const InverseStiffness> inverse,
                           const Options &options, const LowestModes &known)
    : inverse_(std::move(inverse)), M_(M, inverse_->order(), inverse_->held()), options_(options), n_(int(M.rows())),
      Q_(n_)
{
  if (options.block < 1 || !(options.tolerance > 0.))
    throw std::invalid_argument("BlockLanczos: block is " + std::to_string(options.block) + " and tolerance " +
                                std::to_string(options.tolerance) + "; block must be at least 1, tolerance above 0");
  const int        size         = int(known.omega.size());
  constexpr double most_numbers = 4e8; // of the space, where no room is given: 3.2 GB
  // of the space, where no room is given: a dense problem of that size takes a few seconds
  constexpr double most_vectors = 2000;
  const double     n            = inverse_->size();
  const double     usual        = std::min({n, most_vectors, most_numbers / std::max(n, 1.)});
  room_                         = std::max(options.room > 0 ? options.room : int(usual), size + 4 * options_.block);
  if (size > 0)
  {
    MultiVector V(n_, size);
    V.take(known.V, inverse_->order());
    Q_.append(V);
  }
  T_ = known.omega.cwiseAbs2().cwiseInverse().asDiagonal();
  start_block();
}

/// X^T M X of all rows.
MatrixXd BlockLanczos::product(const MultiVector &X, const MultiVector &MX) const
{
  MatrixXd G = gram(X, MX);
  inverse_->sum(G);
  return G;
}

/// Q^T M X, likewise.
MatrixXd BlockLanczos::projection(const MultiVector &MX, int from) const
{
  MatrixXd H = Q_.project(MX, from);
  inverse_->sum(H);
  return H;
}

/// A block of any direction orthogonal to the space; none if the space has the whole range of M.
void BlockLanczos::start_block()
{
  const int   size = Q_.columns();
  MultiVector X    = irregular(*inverse_, std::min(options_.block, inverse_->size() - size), seed_);
  MultiVector MX(n_, X.columns());
  for (int pass = 0; pass < 2; ++pass)
  {
    M_.multiply(X, MX);
    const VectorXd before = norms(product(X, MX));
    Q_.subtract(X, projection(MX));
    M_.multiply(X, MX);
    if (pass == 0 && (norms(product(X, MX)).array() <= 1e-7 * before.array()).all())
      X = MultiVector(n_, 0), MX = MultiVector(n_, 0);
  }
  inverse_->solve_in_place(MX); // removes parts without mass, which would stay in the space
  std::swap(X, MX);
  M_.multiply(X, MX);
  const VectorXd scale = norms(product(X, MX));
  Q_.subtract(X, projection(MX));
  M_.multiply(X, MX);
  std::swap(next_, X);
  std::swap(M_next_, MX);
  E_ = MatrixXd::Identity(next_.columns(), next_.columns());
  set_next(scale);
  E_         = MatrixXd::Zero(next_.columns(), size);
  coupled_   = size;
  exhausted_ = next_.columns() == 0;
}

/// Orthonormalises next_, which is orthogonal to the space up to rounding; E_ <- next_^T M (old next_).
void BlockLanczos::set_next(const VectorXd &scale)
{
  E_ = MatrixXd::Identity(next_.columns(), next_.columns());
  for (int pass = 0; pass < 4 && next_.columns() > 0; ++pass)
  {
    const MatrixXd   products = product(next_, M_next_);
    const VectorXd   size     = norms(products);
    VectorXd         unit(size.size());
    constexpr double broken_down = 1e-10; // share of a vector that orthogonalisation leaves over: rounding
    for (Index j = 0; j < size.size(); ++j)
      unit(j) = size(j) > (pass == 0 ? broken_down * scale(j) : 0.) ? 1. / size(j) : 0.;
    const auto [lambda, all]   = eigen(unit.asDiagonal() * products * unit.asDiagonal(), *inverse_);
    constexpr double dependent = 1e-12; // eigenvalue of the Gram matrix of unit vectors: no direction of its own
    const Index      rank = (lambda.array() > dependent).count(), dropped = lambda.size() - rank;
    const VectorXd   root = lambda.tail(rank).cwiseSqrt();
    const MatrixXd   U    = all.rightCols(rank);
    const MatrixXd   F    = unit.asDiagonal() * U * root.cwiseInverse().asDiagonal();
    next_.transform(F);
    M_next_.transform(F);
    E_ = (root.asDiagonal() * U.transpose() * size.asDiagonal() * E_).eval();
    // the same eigenvalue, above which one pass is sufficient: rounding is then at most 1e-16 / 1e-6
    constexpr double well_apart = 1e-6;
    if (rank == 0 || (dropped == 0 && lambda(0) > well_apart))
      break;
    M_.multiply(next_, M_next_); // few significant figures are left: once more
    Q_.subtract(next_, projection(M_next_));
    M_.multiply(next_, M_next_);
  }
}

void BlockLanczos::step()
{
  const int k = Q_.columns(), b = next_.columns();
  const int from = coupled_;
  Q_.append(next_);
  T_.conservativeResize(k + b, k + b);
  T_.bottomLeftCorner(b, k) = E_;
  T_.topRightCorner(k, b)   = E_.transpose();

  std::swap(next_, M_next_); // the old block is part of the space; its product with M becomes the next block
  inverse_->solve_in_place(next_);
  M_.multiply(next_, M_next_);
  const VectorXd scale = norms(product(next_, M_next_));

  // first what couples, then what rounding left of all the others
  const MatrixXd H           = projection(M_next_, from);
  const MatrixXd own         = H.bottomRows(b);
  T_.bottomRightCorner(b, b) = 0.5 * (own + own.transpose());
  Q_.subtract(next_, H, from);
  M_.multiply(next_, M_next_);
  Q_.subtract(next_, projection(M_next_));
  M_.multiply(next_, M_next_);
  set_next(scale);

  const MatrixXd coupling = E_;
  E_                      = MatrixXd::Zero(next_.columns(), k + b);
  E_.rightCols(b)         = coupling;
  coupled_                = k;
  if (next_.columns() == 0)
    start_block();
}

/// The space of the `keep` best vectors, coupled to the next block as the whole was.
void BlockLanczos::restart(int keep)
{
  const MatrixXd S = S_.leftCols(keep);
  Q_.transform(S);
  T_       = theta_.head(keep).asDiagonal();
  E_       = (E_ * S).eval();
  coupled_ = 0;
}

void BlockLanczos::solve_projected()
{
  if (Q_.columns() == 0)
    return;
  const auto [lambda, vectors] = eigen(T_, *inverse_);
  theta_                       = lambda.reverse();
  S_                           = vectors.rowwise().reverse();
  residual_                    = (E_ * S_).colwise().norm().transpose();
}

int BlockLanczos::n_found() const
{
  int found = 0;
  while (found < theta_.size() && theta_(found) > 0. && residual_(found) <= options_.tolerance * theta_(found))
    ++found;
  return found;
}

/// Least j >= count with theta_j and theta_(j+1) apart, residuals included; -1 if there is none among those found.
int BlockLanczos::gap_index(int count) const
{
  const int found = n_found();
  for (int j = count; j <= found; ++j)
  {
    const double     above = j > 0 ? theta_(j - 1) - residual_(j - 1) : INFINITY;
    const double     next  = j < theta_.size() ? theta_(j) + residual_(j) : exhausted_ ? 0. : INFINITY;
    constexpr double gap   = 1e-4; // of theta, between modes that count as apart: far above the error of theta
    if (next < (1. - gap) * above)
      return j;
  }
  return -1;
}

void BlockLanczos::find(int count)
{
  solve_projected();
  for (int steps = 0; gap_index(count) < 0; ++steps)
  {
    constexpr int max_steps = 1000; // a safety net: the space is full or converged long before
    if (exhausted_ || steps == max_steps)
      throw ConvergenceFailure("lowest modes: " + std::to_string(n_found()) + " of " + std::to_string(count) +
                               (exhausted_
                                    ? " exist, because the mass matrix has no higher rank; request fewer modes"
                                    : " converged in " + std::to_string(max_steps) +
                                          " steps; request fewer modes, or check for an almost unsupported part"));
    if (room_ < count + 4 * options_.block)
      room_ = count + 6 * options_.block;
    if (Q_.columns() + next_.columns() > room_)
    {
      solve_projected();
      restart(std::min(Q_.columns(), std::max(count + options_.block, room_ / 2)));
    }
    step();
    constexpr double sparing = 1.05; // growth of the space after which convergence is checked again
    if (exhausted_ || Q_.columns() >= int(sparing * double(theta_.size())))
      solve_projected();
  }
}

LowestModes BlockLanczos::values(int count) const
{
  if (count > n_found())
    throw std::logic_error("BlockLanczos::modes: only " + std::to_string(n_found()) + " are found");
  const VectorXd share = residual_.head(count).cwiseQuotient(theta_.head(count));
  return {theta_.head(count).cwiseSqrt().cwiseInverse(), MatrixXd(),
          0.5 * (share.array() / (1. - share.array())).matrix()};
}

LowestModes BlockLanczos::modes(int count) const
{
  LowestModes found = values(count);
  Q_.give(S_.leftCols(count), inverse_->order(), found.V);
  return found;
}

BlockLanczos::Gap BlockLanczos::gap_above(int count) const
{
  const int j = gap_index(count);
  if (j < 0)
    throw std::logic_error("BlockLanczos::gap_above: no gap was found above " + std::to_string(count) + " modes");
  const double next = j < theta_.size() ? theta_(j) + residual_(j) : 0.;
  return {j > 0 ? 1. / std::sqrt(theta_(j - 1) - residual_(j - 1)) : 0., next > 0. ? 1. / std::sqrt(next) : INFINITY,
          j};
}

} // namespace gestell::coupling
