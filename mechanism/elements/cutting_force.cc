#include "mechanism/elements/cutting_force.h"

#include "mechanism/require.h"

#include <cmath>

namespace gestell::mechanism
{

CuttingForce::CuttingForce(const Parameters &parameters) : parameters_(parameters)
{
  const auto &[F, z_p, x_T, v0] = parameters_;
  const std::string name        = "cutting force";
  require(F >= 0., name, "peak_force [N]", F, "zero or positive");
  require(z_p > 0., name, "peak_penetration [m]", z_p, "positive");
  require(v0 > 0., name, "speed [m/s]", v0, "positive");
}

void CuttingForce::stiffest(const double *, double *K, double *D) const
{
  *K = parameters_.peak_force * std::exp(1.) / parameters_.peak_penetration;
  *D = 0.;
}

void CuttingForce::guard_values(const LocalMotion &motion, const double *, double *g) const
{
  g[0] = motion.u[0] - parameters_.contact_at;
}

std::vector<Quantity> CuttingForce::quantities() const
{
  return {{"force", "N"}, {"penetration", "m"}};
}

double CuttingForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? resistance(motion, history) : motion.u[0] - parameters_.contact_at;
}

} // namespace gestell::mechanism
