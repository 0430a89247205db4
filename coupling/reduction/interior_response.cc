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
  const auto X = both.leftCols(basis.n1());
  return {symmetric(basis.M_Psi.transpose() * X), symmetric(X.transpose() * symmetric_product(M, X)),
          both.rightCols(loads.cols())};
}

} // namespace gestell::coupling
