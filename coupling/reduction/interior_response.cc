#include "coupling/reduction/interior_response.h"

namespace gestell::coupling
{

InteriorResponse interior_response(const HeldFrame &held, const ReductionBasis &basis,
                                   const Eigen::SparseMatrix<double> &M, const Eigen::MatrixXd &loads)
{
  const auto      symmetric = [](const Eigen::MatrixXd &A) -> Eigen::MatrixXd { return 0.5 * (A + A.transpose()); };
  Eigen::MatrixXd both(M.rows(), basis.n1() + loads.cols());
  both << basis.M_Psi, loads;
  held.solve_in_place(both);
  const auto            X   = both.leftCols(basis.n1());
  const Eigen::MatrixXd M_X = symmetric_product(M, X);
  Eigen::MatrixXd       X2  = M_X;
  held.solve_in_place(X2);
  return {symmetric(basis.M_Psi.transpose() * X), symmetric(X.transpose() * M_X), symmetric(M_X.transpose() * X2),
          both.rightCols(loads.cols())};
}

Eigen::MatrixXd inertia_shapes(const HeldFrame &held, const ReductionBasis &basis)
{
  Eigen::MatrixXd X = basis.M_Psi;
  held.solve_in_place(X);
  return X;
}

} // namespace gestell::coupling
