#include "coupling/machine/sparse_base.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/eigensolvers/sparse_modes.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

void require_size(const SparseBase::Matrix &A, const char *name, Eigen::Index n)
{
  if (A.rows() != n || A.cols() != n)
    throw std::invalid_argument(std::string("SparseBase: ") + name + " is " + std::to_string(A.rows()) + " x " +
                                std::to_string(A.cols()) + "; required: " + std::to_string(n) + " x " +
                                std::to_string(n) + ", as M has that many rows");
}

/// Of bodies in a plane without springs of the base system: every coordinate alone.
class DiagonalSolver final : public LinearSolver
{
public:
  explicit DiagonalSolver(VectorXd inverse) : inverse_(std::move(inverse)) {}
  void solve(const VectorXd &f, VectorXd &x) const override { x = inverse_.cwiseProduct(f); }

private:
  VectorXd inverse_;
};

class SparseSolver final : public LinearSolver
{
public:
  SparseSolver(const SparseBase::Matrix &S, double w_B, const fem::ModalDamping &modal) : factor_(S)
  {
    for (Eigen::Index j = 0; j < modal.d.size(); ++j)
      if (w_B * modal.d(j) > 0.)
      {
        Z_.conservativeResize(S.rows(), Z_.cols() + 1);
        Z_.rightCols(1) = modal.Z.col(j) * std::sqrt(w_B * modal.d(j)); // then the operator is Z Z^T
      }
    if (Z_.cols() == 0)
      return;
    Y_ = Z_;
    factor_.solve_in_place(Y_);
    kernel_.compute(MatrixXd::Identity(Z_.cols(), Z_.cols()) + Z_.transpose() * Y_);
    work_.resize(Z_.cols());
  }

  void solve(const VectorXd &f, VectorXd &x) const override
  {
    factor_.solve(f.data(), x.data());
    if (Z_.cols() == 0)
      return;
    work_.noalias() = Z_.transpose() * x;
    kernel_.solveInPlace(work_);
    x.noalias() -= Y_ * work_;
  }

private:
  SparseCholesky       factor_;
  MatrixXd             Z_, Y_;
  Eigen::LLT<MatrixXd> kernel_;
  mutable VectorXd     work_;
};

} // namespace

SparseBase::SparseBase(Matrix M, Matrix B, Matrix C, fem::ModalDamping modal_damping)
    : M_(std::move(M)), B_(std::move(B)), C_(std::move(C)), modal_(std::move(modal_damping)), work_(modal_.d.size())
{
  require_size(M_, "M", M_.rows());
  require_size(B_, "B", M_.rows());
  require_size(C_, "C", M_.rows());
  if (modal_.d.size() > 0 && (modal_.Z.rows() != M_.rows() || modal_.Z.cols() != modal_.d.size()))
    throw std::invalid_argument("SparseBase: modal damping of " + std::to_string(modal_.Z.rows()) + " x " +
                                std::to_string(modal_.Z.cols()) + " with " + std::to_string(modal_.d.size()) +
                                " values does not fit a system of " + std::to_string(M_.rows()) + " coordinates");
  M_.makeCompressed();
  B_.makeCompressed();
  C_.makeCompressed();
}

void SparseBase::mass_times(const VectorXd &x, VectorXd &y) const
{
  y.noalias() = M_ * x;
}

void SparseBase::damping_times(const VectorXd &x, VectorXd &y) const
{
  y.noalias() = B_ * x;
  if (modal_.d.size() == 0)
    return;
  work_.noalias() = modal_.Z.transpose() * x;
  work_.array() *= modal_.d.array();
  y.noalias() += modal_.Z * work_;
}

void SparseBase::stiffness_times(const VectorXd &x, VectorXd &y) const
{
  y.noalias() = C_ * x;
}

std::unique_ptr<LinearSolver> SparseBase::factorise(double w_M, double w_B, double w_C) const
{
  const Matrix S = w_M * M_ + w_B * B_ + w_C * C_;
  if (const VectorXd d = S.diagonal(); modal_.d.size() == 0 && S.nonZeros() == d.size() && (d.array() > 0.).all())
    return std::make_unique<DiagonalSolver>(d.cwiseInverse());
  try
  {
    return std::make_unique<SparseSolver>(S, w_B, modal_);
  }
  catch (const NotPositiveDefinite &failure)
  {
    throw std::invalid_argument("SparseBase: the matrix of the time step is not positive definite at coordinate " +
                                std::to_string(failure.row) +
                                ": it has neither mass nor stiffness of its own, or negative ones");
  }
}

SpectrumLine SparseBase::line_of(double omega, const VectorXd &mode) const
{
  VectorXd Bv(mode.size());
  damping_times(mode, Bv);
  return {omega, omega > 0. ? mode.dot(Bv) / (2. * omega) : 0.};
}

std::vector<SpectrumLine> SparseBase::spectrum() const
{
  if (C_.nonZeros() == 0) // bodies constrained only by joints and elements
    return std::vector<SpectrumLine>(size(), SpectrumLine{0., 0.});
  constexpr int dense_limit  = 600; // limit for a dense problem that takes less than a second
  const bool    dense        = size() <= dense_limit;
  constexpr int lowest_lines = 20; // of larger ones: those that loads of a machine reach
  const auto    modes        = dense ? dense_modes(MatrixXd(C_), MatrixXd(M_)) : sparse_modes(C_, M_, lowest_lines);

  std::vector<SpectrumLine> lines;
  for (Eigen::Index j = 0; j < modes.omega.size(); ++j)
    lines.push_back(line_of(modes.omega(j), modes.V.col(j)));
  return lines;
}

} // namespace gestell::coupling
