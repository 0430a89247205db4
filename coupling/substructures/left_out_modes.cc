#include "coupling/substructures/left_out_modes.h"

#include <algorithm>
#include <limits>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// M_11 - M_1L M_L1 of a part, whose modes have M_LL = E.
MatrixXd mass_left_out(const ReducedFrame &part)
{
  const Index n_1 = part.n_interface, m = part.M.rows() - n_1;
  return part.M.topLeftCorner(n_1, n_1) - part.M.topRightCorner(n_1, m) * part.M.bottomLeftCorner(m, n_1);
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
  VectorXd errors = VectorXd::Zero(omega.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const ReducedFrame &part = parts[i];
    if (keeps_all(part))
      continue;
    const double   out  = lowest_left_out(part);
    const MatrixXd left = mass_left_out(part), q_1 = G.middleRows(all.first[i], part.n_interface) * V;
    for (Index j = 0; j < omega.size(); ++j)
    {
      const double w_2 = omega[j] * omega[j], beyond = out * out - w_2;
      if (omega[j] > 0. && beyond <= 0.)
        errors[j] = std::numeric_limits<double>::quiet_NaN();
      else if (omega[j] > 0.)
        errors[j] += 0.5 * w_2 / beyond * std::max(0., q_1.col(j).dot(left * q_1.col(j)));
    }
  }
  return errors;
}

} // namespace gestell::coupling
