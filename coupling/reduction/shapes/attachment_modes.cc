#include "coupling/reduction/shapes/attachment_modes.h"

#include "coupling/integration/system/dense_solvers.h"

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd mass_of(const MatrixXd &W, const MatrixXd &MW)
{
  return (W.array() * MW.array()).colwise().sum();
}

} // namespace

int append_attachment_modes(ReductionBasis &basis, const FixedInterfaceFrame &held, MatrixXd W)
{
  if (W.cols() == 0)
    return 0;
  const VectorXd size = mass_of(W, held.mass_times(W)).cwiseSqrt();
  W *= size.unaryExpr([](double s) { return s > 0. ? 1. / s : 0.; }).asDiagonal();
  const MatrixXd M_modes = held.mass_times(basis.fixed_modes());
  for (int again = 0; again < 2; ++again)
    W -= basis.fixed_modes() * (M_modes.transpose() * W);

  const SymmetricEigenSolver mass(W.transpose() * held.mass_times(W));
  // relative size of a shape after projection: its square is rounding of the mass
  constexpr double rounding = 1e-6;
  const auto       dropped  = (mass.eigenvalues().array() <= rounding * rounding).count();
  const auto       kept     = W.cols() - dropped;
  if (kept == 0)
    return 0;
  W = W * mass.eigenvectors().rightCols(kept) * mass.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();

  const SymmetricEigenSolver stiffness(W.transpose() * held.stiffness_times(W));
  MatrixXd                   V(W.rows(), basis.m() + kept);
  VectorXd                   omega(basis.m() + kept);
  V << basis.fixed_modes(), W * stiffness.eigenvectors();
  omega << basis.omega0, stiffness.eigenvalues().cwiseSqrt();
  basis.set_modes(V, omega);
  return int(kept);
}

MatrixXd inertia_relief_shapes(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                               const std::vector<int> &q1)
{
  MatrixXd load(frame.M.rows(), 0);
  if (frame.rigid_motions.cols() == 6)
    load = held.mass_times(frame.rigid_motions);
  else if (frame.translations.rows() > 0)
    load = held.mass_times(frame.translations);
  if (frame.acceleration_load.rows() > 0 && load.cols() >= 3)
    load.leftCols(3) = frame.acceleration_load; // weight, exactly so at clamped supports too
  held.solve_in_place(load);
  for (const int i : q1)
    load.row(i).setZero();
  return load;
}

} // namespace gestell::coupling
