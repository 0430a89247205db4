#include "mechanism/elements/kloss_motor.h"

#include "mechanism/require.h"

namespace gestell::mechanism
{

KlossMotor::KlossMotor(const Parameters &parameters) : parameters_(parameters)
{
  const auto &[M_K, s_K, sync, i] = parameters_;
  const std::string name          = "asynchronous motor";
  require(M_K > 0., name, "breakdown_torque [N m]", M_K, "positive");
  require(s_K > 0., name, "breakdown_slip", s_K, "positive");
  require(sync != 0., name, "synchronous_speed [rad/s]", sync, "different from zero");
  require(i > 0., name, "ratio", i, "positive");
}

std::vector<Quantity> KlossMotor::quantities() const
{
  return {{"torque", "N m"}, {"power", "W"}, {"slip", "1"}};
}

double KlossMotor::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (i == 2)
    return 1. - parameters_.ratio / parameters_.synchronous_speed * motion.v[0];
  double p;
  force(motion, history, &p);
  return i == 0 ? p : p * motion.v[0];
}

} // namespace gestell::mechanism
