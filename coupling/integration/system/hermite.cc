#include "coupling/integration/system/hermite.h"

namespace gestell::coupling
{

InterpolationWeights hermite_weights(const double *t_i, int n, double t)
{
  InterpolationWeights weights;
  weights.n = n;
  for (int i = 0; i < n; ++i)
  {
    // L_i(t) and its slopes at t and t_i;  Hermite: f_i (1 - 2 (t - t_i) L_i'(t_i)) L_i^2 + f'_i (t - t_i) L_i^2
    double L = 1., slope_here = 0., slope_own = 0.;
    for (int j = 0; j < n; ++j)
      if (j != i)
      {
        const double inverse = 1. / (t_i[i] - t_i[j]);
        double       others  = inverse;
        for (int k = 0; k < n; ++k)
          if (k != i && k != j)
            others *= (t - t_i[k]) / (t_i[i] - t_i[k]);
        slope_here += others;
        slope_own += inverse;
        L *= (t - t_i[j]) * inverse;
      }
    const double d        = t - t_i[i];
    weights.lagrange[i]   = L;
    weights.value[i]      = (1. - 2. * d * slope_own) * L * L;
    weights.slope[i]      = d * L * L;
    weights.rate_value[i] = -2. * slope_own * L * L + (1. - 2. * d * slope_own) * 2. * L * slope_here;
    weights.rate_slope[i] = L * L + d * 2. * L * slope_here;
  }
  return weights;
}

} // namespace gestell::coupling
