#include "coupling/reduction/lowest_modes.h"

#include "coupling/integration/second_order_system.h"
#include "coupling/reduction/basis.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int    max_steps    = 1000;
constexpr double most_numbers = 4e8;   // of the space, where no room is given
constexpr double most_vectors = 2000;  // the same
constexpr double broken_down  = 1e-10; // share of a vector that orthogonalisation leaves over: rounding
constexpr double dependent    = 1e-12; // eigenvalue of the Gram matrix of unit vectors: no direction of its own
constexpr double well_apart   = 1e-6;  // the same, from which once is enough
constexpr double sparing      = 1.05;  // growth of the space from which convergence is looked at again
constexpr double gap          = 1e-4;  // of theta, between modes that count as apart

/// Numbers in [-1, 1), always the same for a seed.
MatrixXd irregular(Index rows, Index columns, unsigned long &seed)
{
  MatrixXd X(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i)
    {
      std::uint64_t z = (seed += 0x9E3779B97F4A7C15u);
      z               = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
      z               = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
      X(i, j)         = std::ldexp(double((z ^ (z >> 31)) >> 11), -52) - 1.;
    }
  return X;
}

VectorXd norms(const MatrixXd &X, const MatrixXd &MX)
{
  return (X.array() * MX.array()).colwise().sum().max(0.).sqrt().matrix().transpose();
}

} // namespace

BlockLanczos::BlockLanczos(const Eigen::SparseMatrix<double> &M, InverseStiffness inverse, const Options &options,
                           const LowestModes &known)
    : M_(M), inverse_(std::move(inverse)), options_(options), n_(M.rows()), size_(int(known.omega.size()))
{
  if (options.block < 1 || !(options.tolerance > 0.))
    throw std::invalid_argument("BlockLanczos: block is " + std::to_string(options.block) + " and tolerance " +
                                std::to_string(options.tolerance) + "; needed are 1 or more, and above zero");
  room_ = options.room > 0 ? options.room
                           : int(std::min<double>({double(n_), most_vectors, most_numbers / double(n_ > 0 ? n_ : 1)}));
  room_ = std::max(room_, size_ + 4 * options.block);
  Q_.resize(n_, room_); // without values: memory is taken as columns are written
  if (size_ > 0)
    Q_.leftCols(size_) = known.V;
  T_ = known.omega.cwiseAbs2().cwiseInverse().asDiagonal();
  start_block();
}

/// A block of any direction orthogonal to the space; none if the space has the whole range of M.
void BlockLanczos::start_block()
{
  const auto Q = Q_.leftCols(size_);
  MatrixXd   X = irregular(n_, std::min<Index>(options_.block, n_ - size_), seed_);
  MatrixXd   MX;
  for (int pass = 0; pass < 2; ++pass)
  {
    symmetric_product(M_, X, MX);
    const VectorXd before = norms(X, MX);
    X.noalias() -= Q * (Q.transpose() * MX).eval();
    symmetric_product(M_, X, MX);
    if (pass == 0 && (norms(X, MX).array() <= 1e-7 * before.array()).all())
      X.resize(n_, 0), MX.resize(n_, 0);
  }
  inverse_(MX); // what of it has no mass would never leave the space
  X.swap(MX);
  symmetric_product(M_, X, MX);
  const VectorXd scale = norms(X, MX);
  X.noalias() -= Q * (Q.transpose() * MX).eval();
  symmetric_product(M_, X, MX);
  set_next(std::move(X), std::move(MX), scale);
  E_       = MatrixXd::Zero(next_.cols(), size_);
  coupled_ = size_;
  M_last_.resize(n_, 0);
  exhausted_ = next_.cols() == 0;
}

/// next_ <- orthonormal basis of W, which is orthogonal to the space but for rounding; E_ <- next_^T M W.
void BlockLanczos::set_next(MatrixXd W, MatrixXd MW, const VectorXd &scale)
{
  E_ = MatrixXd::Identity(W.cols(), W.cols());
  for (int pass = 0; pass < 4 && W.cols() > 0; ++pass)
  {
    const MatrixXd gram = W.transpose() * MW;
    const VectorXd size = gram.diagonal().cwiseMax(0.).cwiseSqrt();
    VectorXd       unit(size.size());
    for (Index j = 0; j < size.size(); ++j)
      unit(j) = size(j) > (pass == 0 ? broken_down * scale(j) : 0.) ? 1. / size(j) : 0.;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> scaled(unit.asDiagonal() * gram * unit.asDiagonal());
    const VectorXd                               &lambda = scaled.eigenvalues();
    const Index    rank = (lambda.array() > dependent).count(), dropped = lambda.size() - rank;
    const VectorXd root = lambda.tail(rank).cwiseSqrt();
    const MatrixXd U    = scaled.eigenvectors().rightCols(rank);
    const MatrixXd F    = unit.asDiagonal() * U * root.cwiseInverse().asDiagonal();
    W                   = (W * F).eval();
    E_                  = (root.asDiagonal() * U.transpose() * size.asDiagonal() * E_).eval();
    if (rank == 0 || (dropped == 0 && lambda(0) > well_apart))
    {
      MW = (MW * F).eval();
      break;
    }
    const auto Q = Q_.leftCols(size_); // few significant figures are left: once more
    symmetric_product(M_, W, MW);
    W.noalias() -= Q * (Q.transpose() * MW).eval();
    symmetric_product(M_, W, MW);
  }
  next_.swap(W);
  M_next_.swap(MW);
}

void BlockLanczos::append_block(const MatrixXd &block)
{
  const int k = size_, b = int(block.cols());
  Q_.middleCols(k, b) = block;
  T_.conservativeResize(k + b, k + b);
  T_.bottomLeftCorner(b, k)  = E_;
  T_.topRightCorner(k, b)    = E_.transpose();
  T_.bottomRightCorner(b, b) = MatrixXd::Zero(b, b);
  size_ += b;
}

void BlockLanczos::step()
{
  const int      k = size_, b = int(next_.cols());
  const bool     all_coupled = coupled_ == 0 || M_last_.cols() != k - coupled_;
  const MatrixXd M_last      = std::move(M_last_);
  MatrixXd       M_now = std::move(M_next_), W = std::move(next_), MW;
  append_block(W);
  W = M_now;
  inverse_(W);
  symmetric_product(M_, W, MW);
  const VectorXd scale = norms(W, MW);

  // first what couples, then what rounding left of all the others
  const int      from        = all_coupled ? 0 : coupled_;
  const auto     near        = Q_.middleCols(from, size_ - from);
  const MatrixXd H           = near.transpose() * MW;
  const MatrixXd own         = H.bottomRows(b);
  T_.bottomRightCorner(b, b) = 0.5 * (own + own.transpose());
  W.noalias() -= near * H;
  if (all_coupled)
    symmetric_product(M_, W, MW);
  else
  {
    MW.noalias() -= M_last * H.topRows(k - from);
    MW.noalias() -= M_now * own;
  }
  const auto     Q    = Q_.leftCols(size_);
  const MatrixXd rest = Q.transpose() * MW;
  W.noalias() -= Q * rest;
  symmetric_product(M_, W, MW);
  set_next(std::move(W), std::move(MW), scale);

  MatrixXd E     = MatrixXd::Zero(next_.cols(), size_);
  E.rightCols(b) = E_;
  E_             = E;
  coupled_       = k;
  M_last_        = std::move(M_now);
  if (next_.cols() == 0)
    start_block();
}

/// The space of the `keep` best vectors, coupled to the next block as the whole was.
void BlockLanczos::restart(int keep)
{
  const MatrixXd S = S_.leftCols(keep);
  for (Index first = 0; first < n_; first += 4096) // in place, by rows
  {
    const Index rows                          = std::min<Index>(4096, n_ - first);
    Q_.middleRows(first, rows).leftCols(keep) = (Q_.middleRows(first, rows).leftCols(size_) * S).eval();
  }
  T_    = theta_.head(keep).asDiagonal();
  E_    = (E_ * S).eval();
  size_ = keep;
  M_last_.resize(n_, 0);
  coupled_ = 0;
}

void BlockLanczos::solve_projected()
{
  if (size_ == 0)
    return;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(T_);
  theta_    = ritz.eigenvalues().reverse();
  S_        = ritz.eigenvectors().rowwise().reverse();
  residual_ = (E_ * S_).colwise().norm().transpose();
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
    const double above = j > 0 ? theta_(j - 1) - residual_(j - 1) : INFINITY;
    const double next  = j < theta_.size() ? theta_(j) + residual_(j) : exhausted_ ? 0. : INFINITY;
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
    if (exhausted_ || steps == max_steps)
      throw ConvergenceFailure("lowest modes: " + std::to_string(n_found()) + " of " + std::to_string(count) +
                               (exhausted_
                                    ? " exist, for the mass matrix has no higher rank; ask for fewer modes"
                                    : " converged in " + std::to_string(max_steps) +
                                          " steps; ask for fewer modes, or look for a part that is almost loose"));
    const int b = int(next_.cols()), needed = count + 4 * options_.block;
    if (room_ < needed)
    {
      room_ = needed + 2 * options_.block;
      Q_.conservativeResize(Eigen::NoChange, room_);
    }
    if (size_ + b > room_)
    {
      solve_projected();
      restart(std::min(size_, std::max(count + options_.block, room_ / 2)));
    }
    step();
    if (exhausted_ || size_ >= int(sparing * double(theta_.size())))
      solve_projected();
  }
}

LowestModes BlockLanczos::modes(int count) const
{
  if (count > n_found())
    throw std::logic_error("BlockLanczos::modes: only " + std::to_string(n_found()) + " are found");
  const VectorXd share = residual_.head(count).cwiseQuotient(theta_.head(count));
  return {theta_.head(count).cwiseSqrt().cwiseInverse(), Q_.leftCols(size_) * S_.leftCols(count),
          0.5 * (share.array() / (1. - share.array())).matrix()};
}

BlockLanczos::Gap BlockLanczos::gap_above(int count) const
{
  const int j = gap_index(count);
  if (j < 0)
    throw std::logic_error("BlockLanczos::gap_above: no gap is known above " + std::to_string(count) + " modes");
  const double next = j < theta_.size() ? theta_(j) + residual_(j) : 0.;
  return {j > 0 ? 1. / std::sqrt(theta_(j - 1) - residual_(j - 1)) : 0., next > 0. ? 1. / std::sqrt(next) : INFINITY,
          j};
}

} // namespace gestell::coupling
