#pragma once

#include "coupling/eigensolvers/block_lanczos.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <exception>
#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * (C - omega^2 M) v = 0 in the layout of PETSc vectors: without fixed coordinates, and on each process with its own
 * rows. Matrices are not copied.  Products and solutions are collective.
 */
class ModeProblem
{
public:
  /// Both matrices must outlive it.
  /// @param M  [n x n] by coordinates, both triangles stored; with several processes each has a part of the sum.
  /// @param C  the same; null for methods that use only M and C^-1.
  ModeProblem(std::shared_ptr<const InverseStiffness> inverse, const Eigen::SparseMatrix<double> &M,
              const Eigen::SparseMatrix<double> *C);

  const std::shared_ptr<const InverseStiffness> &inverse() const { return inverse_; }
  const Eigen::SparseMatrix<double>             &M() const { return M_; }
  const Eigen::SparseMatrix<double>             *C() const { return C_; }

  /// Coordinate of every row of a vector here, ascending.
  const std::vector<int> &free() const { return free_; }
  int                     rows() const { return int(free_.size()); }
  int                     coordinates() const { return int(M_.rows()); } ///< here

  /// X [rows x k] <- C^-1 F
  void solve(const Eigen::Ref<const Eigen::MatrixXd> &F, Eigen::Ref<Eigen::MatrixXd> X) const;
  /// y [rows] <- M x, C x
  void mass_times(const double *x, double *y) const { multiply(M_, x, y); }
  void stiffness_times(const double *x, double *y) const;

  /// Exception thrown in a PETSc callback, since exceptions must not cross C.
  mutable std::exception_ptr failure;

private:
  void multiply(const Eigen::SparseMatrix<double> &A, const double *x, double *y) const;

  std::shared_ptr<const InverseStiffness> inverse_;
  const Eigen::SparseMatrix<double>      &M_;
  const Eigen::SparseMatrix<double>      *C_;
  std::vector<int>                        free_;
};

} // namespace gestell::coupling
