#include "coupling/machine/dense_base.h"

#include "coupling/algebra/dense_modes.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double negligible = 1e-12; // entry relative to the roots of its diagonal entries that counts as zero

bool is_zero(const MatrixXd &A)
{
  return A.size() == 0 || A.cwiseAbs().maxCoeff() == 0.;
}

/// Up to the rounding of modes where theory has zeros, as for Rayleigh damping.
bool is_diagonal(const MatrixXd &A)
{
  constexpr double rounding = 1e-10; // of modes that are found to some 1e-12
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      if (i != j && !(std::abs(A(i, j)) <= rounding * std::sqrt(std::abs(A(i, i) * A(j, j)))))
        return false;
  return true;
}

void require(bool condition, const std::string &message)
{
  if (!condition)
    throw std::invalid_argument("DenseBase: " + message);
}

[[noreturn]] void refuse_singular(int coordinate)
{
  throw std::invalid_argument(
      "DenseBase: the matrix of the time step is singular at coordinate " + std::to_string(coordinate) +
      ": it has neither mass nor damping nor stiffness of its own; give it one of them or remove it");
}

/**
 * A^-1 of a symmetric matrix: scaled to unit diagonal, inverted by Cholesky (or by LU if A is indefinite), and improved
 * by one step of Newton's iteration X <- X (2 E - A X), which squares the rounding error.
 * @param names  of the coordinates of the rows of A, for messages.
 */
MatrixXd inverse(const MatrixXd &A, const std::vector<int> &names)
{
  const auto n = A.rows();
  if (n == 0)
    return A;
  const VectorXd d =
      A.diagonal().unaryExpr([](double a) { return a != 0. && std::isfinite(a) ? 1. / std::sqrt(std::abs(a)) : 1.; });
  const MatrixXd             scaled = d.asDiagonal() * A * d.asDiagonal();
  MatrixXd                   X;
  const Eigen::LLT<MatrixXd> cholesky(scaled);
  constexpr double           regular = 1e-14; // smallest pivot of a matrix scaled to unit diagonal
  if (cholesky.info() == Eigen::Success && cholesky.matrixLLT().diagonal().cwiseAbs2().minCoeff() > regular)
    X = cholesky.solve(MatrixXd::Identity(n, n));
  else
  {
    Eigen::FullPivLU<MatrixXd> lu(scaled);
    lu.setThreshold(regular);
    if (!scaled.allFinite() || !lu.isInvertible())
    {
      int worst = 0;
      if (scaled.allFinite())
        lu.kernel().col(0).cwiseAbs().maxCoeff(&worst);
      refuse_singular(names[worst]);
    }
    X = lu.inverse();
  }
  X = (X * (2. * MatrixXd::Identity(n, n) - scaled * X)).eval();
  return d.asDiagonal() * (0.5 * (X + X.transpose())) * d.asDiagonal();
}

/// x = A^-1 f with the inverse of the whole A.
class InverseSolver final : public LinearSolver
{
public:
  explicit InverseSolver(MatrixXd A_inverse) : A_inverse_(std::move(A_inverse))
  {
    if (A_inverse_.isDiagonal(0.))
      alone_ = A_inverse_.diagonal();
  }
  void solve(const VectorXd &f, VectorXd &x) const override
  {
    if (alone_.size() > 0)
      x = alone_.cwiseProduct(f);
    else
      x.noalias() = A_inverse_ * f;
  }

private:
  MatrixXd A_inverse_;
  VectorXd alone_; ///< its diagonal if it has no other entries, as for bodies in a plane; else empty
};

/// to = entries of x at the positions `which`.
void gather(const VectorXd &x, const std::vector<int> &which, VectorXd &to)
{
  for (std::size_t i = 0; i < which.size(); ++i)
    to[Eigen::Index(i)] = x[which[i]];
}

void scatter(const VectorXd &from, const std::vector<int> &which, VectorXd &x)
{
  for (std::size_t i = 0; i < which.size(); ++i)
    x[which[i]] = from[Eigen::Index(i)];
}

/// y = A x + B z; few rows are multiplied without the overhead that products of large matrices have.
void sum_of_products(const MatrixXd &A, const VectorXd &x, const MatrixXd &B, const VectorXd &z, VectorXd &y)
{
  constexpr Eigen::Index few = 32;
  if (y.size() <= few)
  {
    y.noalias() = A.lazyProduct(x);
    y.noalias() += B.lazyProduct(z);
    return;
  }
  y.noalias() = A * x;
  y.noalias() += B * z;
}

/// (5.5.3/4-7) for a diagonal A_LL:  G = A_LL^-1 A_LN,  q_N = A_red^-1 (f_N - G^T f_L),  q_L = A_LL^-1 f_L - G q_N.
class CondensedSolver final : public LinearSolver
{
public:
  /// A_LN, M_LN: their first columns, up to the last one in either that is not zero [n_L x k].
  struct Matrices
  {
    MatrixXd A_NN, A_LN;
    VectorXd A_LL;
    MatrixXd M_NN, M_LN;
  };
  CondensedSolver(const Matrices &matrices, const ModalRange &L, const std::vector<int> &N)
      : L_(L), N_(N), inverse_LL_(matrices.A_LL.cwiseInverse()), M_LN_(matrices.M_LN), k_(matrices.A_LN.cols())
  {
    const auto &[A_NN, A_LN, A_LL, M_NN, M_LN] = matrices;
    const MatrixXd G                           = inverse_LL_.asDiagonal() * A_LN;
    MatrixXd       A                           = A_NN;
    MatrixXd       of_h                        = M_NN;
    A.topLeftCorner(k_, k_) -= A_LN.transpose() * G;
    of_h.topLeftCorner(k_, k_) -= G.transpose() * M_LN;
    A_red_inverse_ = inverse(A, N);
    of_h_          = A_red_inverse_ * of_h;
    if (!find_multiple(A_LN, M_LN))
      A_LN_ = A_LN;
    for (VectorXd *x : {&x_N_, &h_N_, &f_N_})
      x->setZero(A_NN.rows());
    part_N_.setZero(k_);
    x_L_.setZero(L.n);
  }

  void solve(const VectorXd &f, VectorXd &x) const override
  {
    const auto f_L = f.segment(L_.first, L_.n);
    gather(f, N_, f_N_);
    x_L_ = inverse_LL_.cwiseProduct(f_L);
    subtract_A_NL_times(x_L_, f_N_);
    x_N_.noalias() = A_red_inverse_ * f_N_;
    scatter(x_N_, N_, x);
    x.segment(L_.first, L_.n) = f_L;
    subtract_A_LN_times(x_N_, x);
    x.segment(L_.first, L_.n).array() *= inverse_LL_.array();
  }

  const std::vector<int> &leading() const override { return N_; }

  void solve_leading(const VectorXd &h, const VectorXd &f, VectorXd &x) const override
  {
    const auto h_L = h.segment(L_.first, L_.n), f_L = f.segment(L_.first, L_.n);
    gather(h, N_, h_N_);
    gather(f, N_, f_N_);
    if (is_multiple_)
    {
      x_L_ = h_L - multiple_ * inverse_LL_.cwiseProduct(h_L + f_L);
      f_N_.head(k_).noalias() += M_LN_.transpose() * x_L_;
    }
    else
    {
      f_N_.head(k_).noalias() += M_LN_.transpose() * h_L;
      x_L_ = inverse_LL_.cwiseProduct(h_L + f_L);
      subtract_A_NL_times(x_L_, f_N_);
    }
    sum_of_products(of_h_, h_N_, A_red_inverse_, f_N_, x_N_);
    scatter(x_N_, N_, x);
  }

  void solve_following(const VectorXd &h, const VectorXd &f, VectorXd &x) const override
  {
    auto x_L = x.segment(L_.first, L_.n);
    gather(h, N_, h_N_);
    gather(x, N_, x_N_);
    x_L = h.segment(L_.first, L_.n) + f.segment(L_.first, L_.n);
    if (is_multiple_)
      part_N_ = h_N_.head(k_) - multiple_ * x_N_.head(k_);
    else
    {
      part_N_ = h_N_.head(k_);
      x_L.noalias() -= A_LN_ * x_N_.head(k_);
    }
    x_L.noalias() += M_LN_ * part_N_;
    x_L.array() *= inverse_LL_.array();
  }

private:
  /// A_LN = multiple M_LN
  bool find_multiple(const MatrixXd &A_LN, const MatrixXd &M_LN)
  {
    const double square = M_LN.squaredNorm();
    multiple_           = square > 0. ? A_LN.cwiseProduct(M_LN).sum() / square : 0.;
    is_multiple_        = (A_LN - multiple_ * M_LN).norm() <= negligible * A_LN.norm();
    return is_multiple_;
  }

  /// f_N -= A_NL y
  void subtract_A_NL_times(const VectorXd &y, VectorXd &f_N) const
  {
    if (is_multiple_)
      f_N.head(k_).noalias() -= multiple_ * (M_LN_.transpose() * y);
    else
      f_N.head(k_).noalias() -= A_LN_.transpose() * y;
  }

  /// x_L -= A_LN x_N
  void subtract_A_LN_times(const VectorXd &x_N, VectorXd &x) const
  {
    if (is_multiple_)
      x.segment(L_.first, L_.n).noalias() -= multiple_ * (M_LN_ * x_N.head(k_));
    else
      x.segment(L_.first, L_.n).noalias() -= A_LN_ * x_N.head(k_);
  }

  ModalRange       L_;
  std::vector<int> N_;
  VectorXd         inverse_LL_;
  MatrixXd         M_LN_, A_LN_; ///< A_LN is empty where it is a multiple of M_LN
  Eigen::Index     k_;
  double           multiple_    = 0.;
  bool             is_multiple_ = false;
  MatrixXd         A_red_inverse_, of_h_; ///< A_red^-1 (M_NN - G^T M_LN)
  mutable VectorXd x_N_, h_N_, f_N_, part_N_, x_L_;
};

std::vector<int> all_but(int n, const ModalRange &L)
{
  require(L.first >= 0 && L.n >= 0 && L.first + L.n <= n, "the modal coordinates " + std::to_string(L.first) + ".." +
                                                              std::to_string(L.first + L.n - 1) + " lie outside 0.." +
                                                              std::to_string(n - 1));
  std::vector<int> rest;
  for (int i = 0; i < n; ++i)
    if (i < L.first || i >= L.first + L.n)
      rest.push_back(i);
  return rest;
}

/// Number of leading columns that contain all nonzero entries.
Eigen::Index last_column(const MatrixXd &A)
{
  Eigen::Index k = A.cols();
  while (k > 0 && is_zero(A.col(k - 1)))
    --k;
  return k;
}

void require_symmetric(const MatrixXd &A, const char *name, Eigen::Index n)
{
  require(A.rows() == n && A.cols() == n, std::string(name) + " is " + std::to_string(A.rows()) + " x " +
                                              std::to_string(A.cols()) + ", but M has " + std::to_string(n) + " rows");
  require(A.allFinite(), std::string(name) + " contains a value that is not a number");
  require((A - A.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * A.cwiseAbs().maxCoeff(),
          std::string(name) + " is not symmetric");
}

} // namespace

DenseBase::DenseBase(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C, const ModalRange &modal)
    : M_(M), B_(B), C_(C), L_(modal), N_(all_but(int(M.rows()), modal)), x_N_(N_.size()), y_N_(N_.size())
{
  require(M.rows() > 0, "there are no coordinates");
  require_symmetric(M, "M", M.rows());
  require_symmetric(B, "B", M.rows());
  require_symmetric(C, "C", M.rows());
  mass_      = blocks_of(M);
  damping_   = blocks_of(B);
  stiffness_ = blocks_of(C);
  require(mass_.LL.size() == 0 && (mass_.diagonal - VectorXd::Ones(L_.n)).cwiseAbs().sum() <= negligible * L_.n,
          "the modal block of M must be the unit matrix");
  require(stiffness_.LL.size() == 0 && stiffness_.LN.size() == 0,
          "the modal block of C must be diagonal and uncoupled from the rest");
}

DenseBase::Blocks DenseBase::blocks_of(const MatrixXd &A) const
{
  const auto LL = A.block(L_.first, L_.first, L_.n, L_.n);
  Blocks     blocks{A(N_, N_), {}, A.middleRows(L_.first, L_.n)(Eigen::all, N_), LL.diagonal(), LL};
  if (blocks.NN.isDiagonal(0.))
    blocks.alone = blocks.NN.diagonal();
  blocks.LN = blocks.LN.leftCols(last_column(blocks.LN)).eval(); // bodies are not coupled to modes
  if (is_diagonal(blocks.LL))
    blocks.LL.resize(0, 0);
  return blocks;
}

void DenseBase::multiply(const Blocks &A, const VectorXd &x, VectorXd &y) const
{
  const bool is_diagonal = A.alone.size() == A.NN.rows();
  if (L_.n == 0 && is_diagonal)
  {
    y = A.alone.cwiseProduct(x);
    return;
  }
  const auto x_L = x.segment(L_.first, L_.n);
  auto       y_L = y.segment(L_.first, L_.n);
  gather(x, N_, x_N_);
  if (is_diagonal)
    y_N_ = A.alone.cwiseProduct(x_N_);
  else
    y_N_.noalias() = A.NN * x_N_;
  if (A.LL.size() > 0)
    y_L.noalias() = A.LL * x_L;
  else
    y_L = A.diagonal.cwiseProduct(x_L);
  if (A.LN.size() > 0)
  {
    y_N_.head(A.LN.cols()).noalias() += A.LN.transpose() * x_L;
    y_L.noalias() += A.LN * x_N_.head(A.LN.cols());
  }
  scatter(y_N_, N_, y);
}

void DenseBase::mass_times(const VectorXd &x, VectorXd &y) const
{
  multiply(mass_, x, y);
}

void DenseBase::damping_times(const VectorXd &x, VectorXd &y) const
{
  multiply(damping_, x, y);
}

void DenseBase::stiffness_times(const VectorXd &x, VectorXd &y) const
{
  multiply(stiffness_, x, y);
}

std::unique_ptr<LinearSolver> DenseBase::factorise(double w_M, double w_B, double w_C) const
{
  require(std::isfinite(w_M) && std::isfinite(w_B) && std::isfinite(w_C),
          "the weights of the time step are not finite numbers");
  if (L_.n == 0 || (w_B != 0. && damping_.LL.size() > 0))
  {
    std::vector<int> all(M_.rows());
    std::iota(all.begin(), all.end(), 0);
    const MatrixXd A = w_M * M_ + w_B * B_ + w_C * C_;
    require(A.allFinite(), "the matrix of the time step overflows");
    return std::make_unique<InverseSolver>(inverse(A, all));
  }
  // By blocks: most of A is zero, and integrators that change their step call this often.
  const MatrixXd NN       = w_M * mass_.NN + w_B * damping_.NN + w_C * stiffness_.NN;
  const VectorXd diagonal = w_M * mass_.diagonal + w_B * damping_.diagonal + w_C * stiffness_.diagonal;
  const auto     k        = std::max(mass_.LN.cols(), damping_.LN.cols());
  const auto     coupling = [&](const Blocks &A)
  {
    MatrixXd LN              = MatrixXd::Zero(L_.n, k);
    LN.leftCols(A.LN.cols()) = A.LN;
    return LN;
  };
  const MatrixXd M_LN = coupling(mass_), LN = w_M * M_LN + w_B * coupling(damping_);
  require(NN.allFinite() && LN.allFinite() && diagonal.allFinite(), "the matrix of the time step overflows");
  for (Eigen::Index i = 0; i < L_.n; ++i)
    if (diagonal(i) == 0.)
      refuse_singular(L_.first + int(i));
  return std::make_unique<CondensedSolver>(CondensedSolver::Matrices{NN, LN, diagonal, mass_.NN, M_LN}, L_, N_);
}

std::vector<SpectrumLine> DenseBase::spectrum() const
{
  const DenseModes          modes = dense_modes(C_, M_);
  std::vector<SpectrumLine> lines;
  for (Eigen::Index j = 0; j < modes.omega.size(); ++j)
  {
    const double omega = modes.omega(j), two_delta = modes.V.col(j).dot(B_ * modes.V.col(j));
    lines.push_back({omega, omega > 0. ? two_delta / (2. * omega) : 0.});
  }
  return lines;
}

} // namespace gestell::coupling
