#include "coupling/reduction/estimate.h"

#include "coupling/reduction/estimates/mode_selection.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The model's own modes, up to the number that is exact.
RefinedModes exact_modes(const RefinedModes &ritz, Eigen::Index known)
{
  const auto kept = std::min(known, ritz.omega.size());
  return {ritz.n_rigid, ritz.omega.head(kept)};
}

} // namespace

ReductionEstimate estimate(const ReductionSpace &space, const ReducedMatrices &star, const ReductionOptions &options)
{
  const int n1 = space.basis.n1(), m = space.basis.m();
  if (!space.exact)
    return {frequency_estimate(star, n1, m, space.refined), space.limit};
  const RefinedModes own   = ritz_modes(star, space.refined.n_rigid);
  const RefinedModes exact = exact_modes(own, space.exact->size());
  const auto         kept  = exact.omega.size();
  const double       limit = kept > 0 ? std::min((*space.exact)[kept - 1], highest_of_interest(options, own)) : 0.;
  return {frequency_estimate(star, n1, m, exact), limit};
}

StaticRemainder static_remainder(const MatrixXd &deflection, const ReductionBasis &basis, const MatrixXd &load)
{
  MatrixXd f2 = load;
  for (const int i : basis.q1)
    f2.row(i).setZero();
  StaticRemainder remainder{deflection};
  const VectorXd  energy    = (f2.array() * remainder.deflection.array()).colwise().sum();
  const auto      stiffness = basis.omega0.array().square().matrix();
  const MatrixXd  modal     = stiffness.asDiagonal().inverse() * (basis.fixed_modes().transpose() * f2);
  remainder.deflection -= basis.fixed_modes() * modal;
  const VectorXd left = (f2.array() * remainder.deflection.array()).colwise().sum();
  for (int d = 0; d < load.cols(); ++d)
    if (energy(d) > 0.)
      remainder.relative = std::max(remainder.relative, std::sqrt(std::max(0., left(d) / energy(d))));
  return remainder;
}

} // namespace gestell::coupling
