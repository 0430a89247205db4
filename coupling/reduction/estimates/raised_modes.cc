#include "coupling/reduction/estimates/raised_modes.h"

#include "coupling/factors/make_factor.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/reduction/shapes/reduction_basis.h"

#include <algorithm>

namespace gestell::coupling
{

Eigen::VectorXd raised_frequencies(fem::RaisedFrame frame, const Eigen::MatrixXd &X, const Eigen::VectorXd &omega,
                                   bool floats, double available, const std::string &factor)
{
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(frame.C.rows(), X.cols());
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    Y.row(frame.place[i]) = X.row(i);
  Y                       = symmetric_product(frame.M, Y);
  const Eigen::MatrixXd F = Y;
  // Shift, as a share of the lowest omega^2, if rigid motions are free: well below the mode and far above rounding.
  constexpr double shift_share = 0.1;
  const double     s           = floats ? shift_share * omega[0] * omega[0] : 0.;
  if (floats)
    frame.C += s * frame.M;
  frame.C.makeCompressed();
  {
    const auto inverse = make_factor(factor, {nullptr, nullptr, {}, &frame.C, available});
    inverse->factorise();
    inverse->solve_in_place(Y);
  }

  const Eigen::MatrixXd       MY = symmetric_product(frame.M, Y), M = Y.transpose() * MY;
  const Eigen::MatrixXd       C = Y.transpose() * F - s * M; // C3 Y = M3 X - s M3 Y
  const SymmetricPencilSolver ritz(0.5 * (C + C.transpose()), 0.5 * (M + M.transpose()), WithVectors::no);
  return ritz.eigenvalues().cwiseMax(0.).cwiseSqrt();
}

double error_by_raising(double omega, double raised)
{
  // In smooth fields elements of degree three have none of the error of quadratic elements, at an edge with a
  // square-root singularity 4/9 of it. The factor assumes that 1/5 remains.
  constexpr double left_over = 1.25;
  return left_over * std::max(0., omega / raised - 1.);
}

} // namespace gestell::coupling
