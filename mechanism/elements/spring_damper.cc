#include "mechanism/elements/spring_damper.h"

#include "mechanism/require.h"

namespace gestell::mechanism
{

SpringDamper::SpringDamper(const Parameters &parameters) : parameters_(parameters)
{
  require(parameters.stiffness >= 0., "spring-damper", "stiffness [N/m]", parameters.stiffness, "zero or positive");
  require(parameters.damping >= 0., "spring-damper", "damping [N s/m]", parameters.damping, "zero or positive");
}

void SpringDamper::engaged(const double *, double *K, double *D) const
{
  K[0] = parameters_.stiffness;
  D[0] = parameters_.damping;
}

double SpringDamper::stored_energy(const LocalMotion &motion, const double *) const
{
  const double stretch = motion.u[0] - parameters_.rest;
  return (parameters_.preload + 0.5 * parameters_.stiffness * stretch) * stretch;
}

double SpringDamper::stored_power(const LocalMotion &motion, const double *) const
{
  return (parameters_.preload + parameters_.stiffness * (motion.u[0] - parameters_.rest)) * motion.v[0];
}

std::vector<Quantity> SpringDamper::quantities() const
{
  return {{"force", "N"}, {"stretch", "m"}, {"rate", "m/s"}, {"displacement", "m"}};
}

double SpringDamper::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const double values[] = {0., motion.u[0] - parameters_.rest, motion.v[0], motion.u[0]};
  return i == 0 ? resistance(motion, history) : values[i];
}

} // namespace gestell::mechanism
