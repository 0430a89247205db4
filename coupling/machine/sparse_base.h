#pragma once

#include "coupling/machine/linear_base.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/SparseCore>

namespace gestell::coupling
{

/**
 * Large sparse base system with modal damping as an operator of low rank, B + Z diag(d) Z^T.
 *
 * factorise() computes the Cholesky factor of the sparse part S = w_M M + w_B B + w_C C and adds the operator by the
 * Woodbury formula:
 *
 *     A^-1 f = y - Y (diag(1 / (w_B d)) + Z^T Y)^-1 Z^T y,     y = S^-1 f,   Y = S^-1 Z.
 */
class SparseBase : public LinearBase
{
public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// @param M,             B, C        symmetric [n x n], both triangles stored
  /// @param modal_damping  Z [n x p], d [p] >= 0; may be empty
  /// @throws std::invalid_argument for wrong sizes
  SparseBase(Matrix M, Matrix B, Matrix C, fem::ModalDamping modal_damping = {});

  int  size() const override { return int(M_.rows()); }
  void mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  /// @throws std::invalid_argument if the sparse part of A is not positive definite, with the index of the coordinate
  std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const override;

  /// All modes up to 600 coordinates; beyond that, the twenty lowest (see sparse_modes()) and one line for the highest,
  /// with an upper bound of its frequency by Gershgorin circles and no damping.
  std::vector<SpectrumLine> spectrum() const override;

  const Matrix &mass() const { return M_; }
  const Matrix &damping() const { return B_; }
  const Matrix &stiffness() const { return C_; }

private:
  SpectrumLine line_of(double omega, const Eigen::VectorXd &mode) const;

  Matrix                  M_, B_, C_;
  fem::ModalDamping       modal_;
  mutable Eigen::VectorXd work_; // [p]
};

} // namespace gestell::coupling
