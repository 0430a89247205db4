#include "mechanism/elements/unbalance.h"

#include "mechanism/require.h"

#include <cmath>

namespace gestell::mechanism
{

Unbalance::Unbalance(const Parameters &parameters) : parameters_(parameters)
{
  require(parameters.unbalance >= 0., "unbalance", "U [kg m]", parameters.unbalance, "zero or above");
}

std::vector<Quantity> Unbalance::quantities() const
{
  return {{"force", "N"}, {"torque", "N m"}};
}

double Unbalance::quantity(int i, const LocalMotion &motion, const double *history) const
{
  double p[3];
  force(motion, history, p);
  return i == 0 ? std::hypot(p[1], p[2]) : p[0];
}

double Unbalance::stored_energy(const LocalMotion &motion, const double *) const
{
  const auto &[U, psi, g] = parameters_;
  const double c = std::cos(motion.u[0] + psi), s = std::sin(motion.u[0] + psi);
  return U * (motion.v[0] * (motion.v[2] * c - motion.v[1] * s) - g[0] * c - g[1] * s);
}

double Unbalance::stored_power(const LocalMotion &motion, const double *history) const
{
  double p[3];
  force(motion, history, p);
  return -p[0] * motion.v[0] - p[1] * motion.v[1] - p[2] * motion.v[2];
}

} // namespace gestell::mechanism
