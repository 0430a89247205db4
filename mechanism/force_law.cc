#include "mechanism/force_law.h"

#include <cassert>

namespace gestell::mechanism
{

void ForceLaw::derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                           double *dp_dv) const
{
  tangent(motion, history, {1., 0., 0.}, p, dp_du);
  tangent(motion, history, {0., 1., 0.}, p, dp_dv);
}

double ForceLaw::stored_energy(const LocalMotion &, const double *) const
{
  return 0.;
}

double ForceLaw::stored_power(const LocalMotion &, const double *) const
{
  return 0.;
}

double ForceLaw::resistance(const LocalMotion &motion, const double *history) const
{
  assert(n_measures() == 1);
  double p;
  force(motion, history, &p);
  return -p;
}

} // namespace gestell::mechanism
