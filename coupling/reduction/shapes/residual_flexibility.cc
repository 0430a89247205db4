#include "coupling/reduction/shapes/residual_flexibility.h"

namespace gestell::coupling
{

ResidualFlexibility residual_flexibility(const FixedInterfaceFrame &held, const ReductionBasis &basis,
                                         const Eigen::MatrixXd &loads)
{
  const auto      symmetric = [](const Eigen::MatrixXd &A) -> Eigen::MatrixXd { return 0.5 * (A + A.transpose()); };
  Eigen::MatrixXd both(loads.rows(), basis.n1() + loads.cols());
  both << basis.M_Psi, loads;
  held.solve_in_place(both);
  const auto            X     = both.leftCols(basis.n1());
  const Eigen::MatrixXd M_X   = held.mass_times(X);
  const Eigen::MatrixXd first = symmetric(basis.M_Psi.transpose() * X), second = symmetric(X.transpose() * M_X),
                        under_loads = both.rightCols(loads.cols());
  both                              = M_X; // reuses the memory of X: the factor leaves little
  held.solve_in_place(both);
  return {first, second, symmetric(M_X.transpose() * both), under_loads};
}

Eigen::MatrixXd inertia_shapes(const FixedInterfaceFrame &held, const ReductionBasis &basis)
{
  Eigen::MatrixXd X = basis.M_Psi;
  held.solve_in_place(X);
  return X;
}

} // namespace gestell::coupling
