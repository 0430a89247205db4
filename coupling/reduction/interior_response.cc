#include "coupling/reduction/interior_response.h"

namespace gestell::coupling
{

InteriorResponse interior_response(const HeldFrame &held, const ReductionBasis &basis,
                                   const Eigen::SparseMatrix<double> &M, const Eigen::MatrixXd &loads)
{
  Eigen::MatrixXd both(M.rows(), basis.n1() + loads.cols());
  both << basis.MT.leftCols(basis.n1()), loads;
  held.solve_in_place(both);
  InteriorResponse      response{both.leftCols(basis.n1()), {}, both.rightCols(loads.cols())};
  const Eigen::MatrixXd XMX = response.X.transpose() * symmetric_product(M, response.X);
  response.XMX              = 0.5 * (XMX + XMX.transpose());
  return response;
}

} // namespace gestell::coupling
