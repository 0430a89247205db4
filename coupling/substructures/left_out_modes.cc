#include "coupling/substructures/left_out_modes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What static shapes of the basis leave of F.
MatrixXd beside_shapes(const ReducedFrame &part)
{
  const Index    n_1 = part.n_interface, k = part.omega0.size() - part.n_fixed_modes;
  const MatrixXd M_1X = part.M.block(0, part.M.rows() - k, n_1, k);
  return part.left_out - M_1X * part.omega0.tail(k).cwiseAbs2().cwiseInverse().asDiagonal() * M_1X.transpose();
}

/// The lowest frequency that is left out [rad/s]: that of the next mode by the static shapes in their place, which come
/// near to it from above, or else the highest one kept.
double lowest_left_out(const ReducedFrame &part)
{
  const VectorXd &omega = part.omega0;
  const Index     m     = std::min<Index>(part.n_fixed_modes, omega.size());
  if (omega.size() > m)
    return omega.tail(omega.size() - m).minCoeff();
  return m > 0 ? omega[m - 1] : 0.;
}

bool keeps_all(const ReducedFrame &part)
{
  return part.M.rows() >= part.n_full;
}

} // namespace

VectorXd errors_by_modes_left_out(const std::vector<ReducedFrame> &parts, const PartUnion &all, const MatrixXd &G,
                                  const VectorXd &omega, const MatrixXd &V)
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  VectorXd         errors  = VectorXd::Zero(omega.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const ReducedFrame &part = parts[i];
    if (keeps_all(part))
      continue;
    if (part.left_out.size() == 0)
      return VectorXd::Constant(omega.size(), unknown);
    const double   out = lowest_left_out(part);
    const MatrixXd q_1 = G.middleRows(all.first[i], part.n_interface) * V, rest = beside_shapes(part);
    for (Index j = 0; j < omega.size(); ++j)
    {
      const double   r_2  = std::pow(omega[j] / out, 2);
      const MatrixXd F    = rest + r_2 * r_2 * (part.left_out - rest);
      const double   less = 0.5 * omega[j] * omega[j] * q_1.col(j).dot(F * q_1.col(j)) / (1. - r_2);
      errors[j] += r_2 < 1. ? std::max(0., less) : unknown;
    }
  }
  return errors;
}

} // namespace gestell::coupling
