#include "coupling/dense_base.h"

#include "coupling/dense_modes.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double negligible = 1e-12; // entry relative to the roots of its diagonal entries that counts as zero
constexpr double regular    = 1e-14; // smallest pivot of a matrix scaled to unit diagonal

bool is_zero(const MatrixXd &A)
{
  return A.size() == 0 || A.cwiseAbs().maxCoeff() == 0.;
}

/// But for what rounding of the modes leaves where theory has zeros, as of damping after Rayleigh.
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
 * by one step of Newton's iteration X <- X (2 E - A X), which squares what rounding left.
 *
 * @param names of the coordinates the rows of A stand for, for messages.
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
  explicit InverseSolver(MatrixXd A_inverse) : A_inverse_(std::move(A_inverse)) {}
  void solve(const VectorXd &f, VectorXd &x) const override { x.noalias() = A_inverse_ * f; }

private:
  MatrixXd A_inverse_;
};

bool is_ascending(const std::vector<int> &order)
{
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != int(i))
      return false;
  return true;
}

/// (5.5.3/4-7) for a diagonal A_LL:  G = A_LL^-1 A_LN,  q_N = A_red^-1 (f_N - G^T f_L),  q_L = A_LL^-1 f_L - G q_N.
class CondensedSolver final : public LinearSolver
{
public:
  CondensedSolver(const MatrixXd &A_NN, const MatrixXd &A_LN, const VectorXd &A_LL, const std::vector<int> &order)
      : order_(order), sorted_(is_ascending(order)), inverse_LL_(A_LL.cwiseInverse()),
        G_(inverse_LL_.asDiagonal() * A_LN), A_red_inverse_(inverse(A_NN - A_LN.transpose() * G_, order)),
        f_(order.size()), x_(order.size()), f_N_(A_NN.rows())
  {
  }

  void solve(const VectorXd &f, VectorXd &x) const override
  {
    if (sorted_)
      return solve_sorted(f, x);
    for (Eigen::Index i = 0; i < f_.size(); ++i)
      f_(i) = f(order_[i]);
    solve_sorted(f_, x_);
    for (Eigen::Index i = 0; i < x_.size(); ++i)
      x(order_[i]) = x_(i);
  }

private:
  void solve_sorted(const VectorXd &f, VectorXd &x) const
  {
    const auto n_N = f_N_.size(), n_L = inverse_LL_.size();
    f_N_ = f.head(n_N);
    f_N_.noalias() -= G_.transpose() * f.tail(n_L);
    x.head(n_N).noalias() = A_red_inverse_ * f_N_;
    x.tail(n_L)           = inverse_LL_.cwiseProduct(f.tail(n_L));
    x.tail(n_L).noalias() -= G_ * x.head(n_N);
  }

  std::vector<int> order_;  // N, then L
  bool             sorted_; // in the order of the coordinates
  VectorXd         inverse_LL_;
  MatrixXd         G_, A_red_inverse_;
  mutable VectorXd f_, x_, f_N_;
};

std::vector<int> rest_then_modal(int n, const std::vector<int> &L)
{
  std::vector<char> modal(n, 0);
  for (const int i : L)
  {
    require(i >= 0 && i < n, "modal coordinate " + std::to_string(i) + " lies outside 0.." + std::to_string(n - 1));
    require(!modal[i], "modal coordinate " + std::to_string(i) + " is named twice");
    modal[i] = 1;
  }
  std::vector<int> order;
  for (int i = 0; i < n; ++i)
    if (!modal[i])
      order.push_back(i);
  order.insert(order.end(), L.begin(), L.end());
  return order;
}

void require_symmetric(const MatrixXd &A, const char *name, Eigen::Index n)
{
  require(A.rows() == n && A.cols() == n, std::string(name) + " is " + std::to_string(A.rows()) + " x " +
                                              std::to_string(A.cols()) + ", but M has " + std::to_string(n) + " rows");
  require(A.allFinite(), std::string(name) + " holds a value that is no number");
  require((A - A.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * A.cwiseAbs().maxCoeff(),
          std::string(name) + " is not symmetric");
}

} // namespace

DenseBase::DenseBase(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C, const std::vector<int> &modal_coordinates)
    : M_(M), B_(B), C_(C), order_(rest_then_modal(int(M.rows()), modal_coordinates)), sorted_(is_ascending(order_)),
      n_N_(int(M.rows() - modal_coordinates.size())), x_(M.rows()), y_(M.rows())
{
  const auto n_L = Eigen::Index(modal_coordinates.size());
  require(M.rows() > 0, "there are no coordinates");
  require_symmetric(M, "M", M.rows());
  require_symmetric(B, "B", M.rows());
  require_symmetric(C, "C", M.rows());
  mass_      = blocks_of(M);
  damping_   = blocks_of(B);
  stiffness_ = blocks_of(C);
  require(mass_.LL.size() == 0 && (mass_.diagonal - VectorXd::Ones(n_L)).cwiseAbs().sum() <= negligible * n_L,
          "the modal block of M must be the unit matrix");
  require(stiffness_.LL.size() == 0 && stiffness_.LN.size() == 0,
          "the modal block of C must be diagonal and uncoupled from the rest");
}

DenseBase::Blocks DenseBase::blocks_of(const MatrixXd &A) const
{
  const std::vector<int> N(order_.begin(), order_.begin() + n_N_), L(order_.begin() + n_N_, order_.end());
  Blocks                 blocks{A(N, N), A(L, N), A(L, L).diagonal(), A(L, L)};
  if (is_zero(blocks.LN))
    blocks.LN.resize(0, 0);
  if (is_diagonal(blocks.LL))
    blocks.LL.resize(0, 0);
  return blocks;
}

void DenseBase::multiply(const Blocks &A, const VectorXd &x, VectorXd &y) const
{
  if (sorted_)
    return multiply_sorted(A, x, y);
  for (Eigen::Index i = 0; i < x_.size(); ++i)
    x_(i) = x(order_[i]);
  multiply_sorted(A, x_, y_);
  for (Eigen::Index i = 0; i < y_.size(); ++i)
    y(order_[i]) = y_(i);
}

void DenseBase::multiply_sorted(const Blocks &A, const VectorXd &x, VectorXd &y) const
{
  const auto n_L = x.size() - n_N_;
  const auto x_N = x.head(n_N_), x_L = x.tail(n_L);
  auto       y_N = y.head(n_N_), y_L = y.tail(n_L);

  y_N.noalias() = A.NN * x_N;
  if (A.LL.size() > 0)
    y_L.noalias() = A.LL * x_L;
  else
    y_L = A.diagonal.cwiseProduct(x_L);
  if (A.LN.size() > 0)
  {
    y_N.noalias() += A.LN.transpose() * x_L;
    y_L.noalias() += A.LN * x_N;
  }
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
  const auto n_L = Eigen::Index(order_.size()) - n_N_;
  require(std::isfinite(w_M) && std::isfinite(w_B) && std::isfinite(w_C),
          "the weights of the time step are no finite numbers");
  if (n_L == 0 || (w_B != 0. && damping_.LL.size() > 0))
  {
    std::vector<int> all(order_.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = int(i);
    const MatrixXd A = w_M * M_ + w_B * B_ + w_C * C_;
    require(A.allFinite(), "the matrix of the time step overflows");
    return std::make_unique<InverseSolver>(inverse(A, all));
  }
  // By blocks: the whole of A is mostly zeros, and integrators that change their step ask often.
  const MatrixXd NN       = w_M * mass_.NN + w_B * damping_.NN + w_C * stiffness_.NN;
  const VectorXd diagonal = w_M * mass_.diagonal + w_B * damping_.diagonal + w_C * stiffness_.diagonal;
  MatrixXd       LN       = MatrixXd::Zero(n_L, n_N_);
  if (mass_.LN.size() > 0)
    LN += w_M * mass_.LN;
  if (damping_.LN.size() > 0)
    LN += w_B * damping_.LN;
  require(NN.allFinite() && LN.allFinite() && diagonal.allFinite(), "the matrix of the time step overflows");
  for (Eigen::Index i = 0; i < n_L; ++i)
    if (diagonal(i) == 0.)
      refuse_singular(order_[n_N_ + i]);
  return std::make_unique<CondensedSolver>(NN, LN, diagonal, order_);
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
