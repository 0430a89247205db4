#include "coupling/integration/force_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

void ExactContext::grow_scale(const Eigen::VectorXd &u, const Eigen::VectorXd &v, double h)
{
  constexpr double rounding = 8. * std::numeric_limits<double>::epsilon();
  for (Eigen::Index i = 0; i < u.size(); ++i)
    scale[i] = std::max({scale[i], std::abs(u[i] - u_begin[i]), h * std::abs(v[i]),
                         rounding / newton.tolerance * std::abs(u[i])});
}

HermiteNodes::HermiteNodes(std::vector<double> sigma)
    : sigma_(std::move(sigma)), inverse_(sigma_.size(), 1.), own_slope_(sigma_.size(), 0.)
{
  for (std::size_t i = 0; i < sigma_.size(); ++i)
    for (std::size_t j = 0; j < sigma_.size(); ++j)
      if (j != i)
      {
        inverse_[i] /= sigma_[i] - sigma_[j];
        own_slope_[i] += 1. / (sigma_[i] - sigma_[j]);
      }
}

void HermiteNodes::weights(double sigma, double *value, double *slope, double *rate_value, double *rate_slope) const
{
  const int n = size();
  for (int i = 0; i < n; ++i)
  {
    double L = inverse_[i], L_slope = 0.;
    for (int j = 0; j < n; ++j)
      if (j != i)
      {
        L_slope = L_slope * (sigma - sigma_[j]) + L;
        L *= sigma - sigma_[j];
      }
    const double d = sigma - sigma_[i], square = L * L, b = 1. - 2. * d * own_slope_[i];
    value[i]      = b * square;
    slope[i]      = d * square;
    rate_value[i] = -2. * own_slope_[i] * square + 2. * b * L * L_slope;
    rate_slope[i] = square + 2. * d * L * L_slope;
  }
}

} // namespace gestell::coupling
