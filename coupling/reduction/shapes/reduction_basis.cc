#include "coupling/reduction/shapes/reduction_basis.h"

#include <cassert>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

MatrixXd symmetric(const MatrixXd &A)
{
  return 0.5 * (A + A.transpose());
}

} // namespace

void symmetric_product(const SparseMatrix &A, const Eigen::Ref<const MatrixXd> &X, MatrixXd &Y)
{
  assert(A.isCompressed() && A.cols() == X.rows());
  const auto                                   n     = A.cols();
  const int                                   *start = A.outerIndexPtr(), *row = A.innerIndexPtr();
  const auto                                  *a     = A.valuePtr();
  constexpr int                                lanes = 8;   // columns that travel together: a cache line of doubles
  Eigen::Matrix<double, lanes, Eigen::Dynamic> x(lanes, n); // row i of X: eight columns, contiguous
  Y.resize(n, X.cols());
  for (Eigen::Index first = 0; first < X.cols(); first += lanes)
  {
    const auto width = std::min<Eigen::Index>(lanes, X.cols() - first);
    if (width < lanes)
      x.setZero();
    x.topRows(width) = X.middleCols(first, width).transpose();
    for (Eigen::Index j = 0; j < n; ++j)
    {
      Eigen::Matrix<double, lanes, 1> sum = Eigen::Matrix<double, lanes, 1>::Zero();
      for (int k = start[j]; k < start[j + 1]; ++k)
        sum += a[k] * x.col(row[k]);
      Y.row(j).segment(first, width) = sum.head(width).transpose();
    }
  }
}

MatrixXd symmetric_product(const SparseMatrix &A, const Eigen::Ref<const MatrixXd> &X)
{
  MatrixXd Y;
  symmetric_product(A, X, Y);
  return Y;
}

void ReductionBasis::set_modes(const Eigen::Ref<const MatrixXd> &V, const VectorXd &omega)
{
  const Eigen::Index n1 = this->n1(), m = V.cols();
  T.conservativeResize(Eigen::NoChange, n1 + m);
  T.rightCols(m) = V;
  omega0         = omega;
}

void ReductionBasis::truncate(int m)
{
  assert(m <= this->m());
  T.conservativeResize(Eigen::NoChange, n1() + m);
  omega0.conservativeResize(m);
}

ReducedMatrices reduced_matrices(const ReductionBasis &basis, const SparseMatrix &B)
{
  const int   n1 = basis.n1(), m = basis.m();
  const auto &M_Psi = basis.M_Psi;

  ReducedMatrices star;
  star.M                         = MatrixXd::Identity(n1 + m, n1 + m);
  star.M.topLeftCorner(n1, n1)   = symmetric(basis.constraint_modes().transpose() * M_Psi);
  star.M.topRightCorner(n1, m)   = M_Psi.transpose() * basis.fixed_modes();
  star.M.bottomLeftCorner(m, n1) = star.M.topRightCorner(n1, m).transpose();

  star.C                                    = MatrixXd::Zero(n1 + m, n1 + m);
  star.C.topLeftCorner(n1, n1)              = basis.C_11;
  star.C.bottomRightCorner(m, m).diagonal() = basis.omega0.cwiseAbs2();

  star.B = MatrixXd::Zero(n1 + m, n1 + m);
  if (B.nonZeros() > 0)
    star.B = symmetric(basis.T.transpose() * symmetric_product(B, basis.T));
  return star;
}

VectorXd project_initial(const ReductionBasis &basis, const SparseMatrix &C, const VectorXd &q)
{
  VectorXd p(basis.n1() + basis.m());
  for (int i = 0; i < basis.n1(); ++i)
    p(i) = q(basis.q1[i]);
  // V is zero on q1, so V^T C q is V22^T C21 q1 + V22^T C22 q2
  p.tail(basis.m()) = (basis.fixed_modes().transpose() * (C * q)).cwiseQuotient(basis.omega0.cwiseAbs2());
  return p;
}

} // namespace gestell::coupling
