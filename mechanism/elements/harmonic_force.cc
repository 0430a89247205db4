#include "mechanism/elements/harmonic_force.h"

namespace gestell::mechanism
{

std::vector<Quantity> HarmonicForce::quantities() const
{
  if (parameters_.torque)
    return {{"torque", "N m"}, {"force", "N m"}};
  return {{"force", "N"}};
}

double HarmonicForce::quantity(int, const LocalMotion &motion, const double *history) const
{
  return -resistance(motion, history);
}

} // namespace gestell::mechanism
