#include "coupling/machine/dense_base.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/machine/condensed_solver.h"

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
    : M_(M), B_(B), C_(C), L_(modal), N_(all_but(int(M.rows()), modal)), x_N_(VectorXd::Zero(Eigen::Index(N_.size()))),
      y_N_(VectorXd::Zero(PackedMatrix::padded(Eigen::Index(N_.size()))))
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
  require(stiffness_.LL.size() == 0 && stiffness_.LN.is_empty(),
          "the modal block of C must be diagonal and uncoupled from the rest");
}

DenseBase::Blocks DenseBase::blocks_of(const MatrixXd &A) const
{
  const auto     LL = A.block(L_.first, L_.first, L_.n, L_.n);
  const MatrixXd NN = A(N_, N_);
  MatrixXd       LN = A.middleRows(L_.first, L_.n)(Eigen::all, N_);
  LN                = LN.leftCols(last_column(LN)).eval(); // bodies are not coupled to modes
  Blocks blocks{PackedMatrix(NN), {}, PackedMatrix(LN), LL.diagonal(), LL};
  if (NN.isDiagonal(0.))
    blocks.alone = NN.diagonal();
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
  y_N_.setZero();
  if (is_diagonal)
    y_N_.head(x_N_.size()) = A.alone.cwiseProduct(x_N_);
  else
    A.NN.add_product(x_N_.data(), y_N_.data());
  if (A.LL.size() > 0)
    y_L.noalias() = A.LL * x_L;
  else
    y_L = A.diagonal.cwiseProduct(x_L);
  if (!A.LN.is_empty())
  {
    A.LN.add_transposed_product(x_L.data(), y_N_.data());
    A.LN.add_product_within(x_N_.data(), y_L.data());
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
    return std::make_unique<InverseSolver>(symmetric_inverse(A, all));
  }
  // By blocks: most of A is zero, and integrators that change their step call this often.
  const auto NN_of = [&](const MatrixXd &A) { return A(N_, N_); };
  const auto k     = std::max(mass_.LN.cols(), damping_.LN.cols());
  const auto LN_of = [&](const MatrixXd &A)
  { return MatrixXd(A.middleRows(L_.first, L_.n)(Eigen::all, std::vector<int>(N_.begin(), N_.begin() + k))); };
  const MatrixXd M_NN = NN_of(M_), NN = w_M * M_NN + w_B * NN_of(B_) + w_C * NN_of(C_), M_LN = LN_of(M_),
                 LN       = w_M * M_LN + w_B * LN_of(B_);
  const VectorXd diagonal = w_M * mass_.diagonal + w_B * damping_.diagonal + w_C * stiffness_.diagonal;
  require(NN.allFinite() && LN.allFinite() && diagonal.allFinite(), "the matrix of the time step overflows");
  for (Eigen::Index i = 0; i < L_.n; ++i)
    if (diagonal(i) == 0.)
      refuse_singular(L_.first + int(i));
  return condensed_solver({NN, LN, diagonal, M_NN, M_LN}, L_, N_);
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
