#include "mechanism/elements/dynamic_motor.h"

namespace gestell::mechanism
{

std::vector<Quantity> DynamicMotor::quantities() const
{
  return {{"torque", "N m"}, {"power", "W"}, {"slip", "1"}, {"stationary_torque", "N m"}};
}

double DynamicMotor::quantity(int i, const LocalMotion &motion, const double *history) const
{
  switch (i)
  {
  case 0:
    return motion.u[1];
  case 1:
    return motion.u[1] * motion.v[0];
  case 2:
    return motor_.quantity(2, motion, history);
  default:
    return motor_.quantity(0, motion, history);
  }
}

} // namespace gestell::mechanism
