#include "mechanism/elements/wheel.h"

#include "mechanism/require.h"

#include <algorithm>

namespace gestell::mechanism
{

Wheel::Wheel(const Parameters &parameters) : parameters_(parameters)
{
  require(parameters.stiffness > 0., "wheel", "stiffness [N/m]", parameters.stiffness, "positive");
  require(parameters.damping >= 0., "wheel", "damping [N s/m]", parameters.damping, "zero or positive");
}

void Wheel::engaged(const double *, double *K, double *D) const
{
  K[0] = parameters_.stiffness;
  D[0] = parameters_.damping;
}

void Wheel::open_branch(const double *u, double *K, double *D) const
{
  if (parameters_.bilateral)
    engaged(u, K, D);
}

double Wheel::stored_energy(const LocalMotion &motion, const double *) const
{
  const double d = deflection(motion);
  return 0.5 * parameters_.stiffness * d * d;
}

double Wheel::stored_power(const LocalMotion &motion, const double *) const
{
  return parameters_.stiffness * deflection(motion) * motion.v[0];
}

/// Deflection of the tyre; after liftoff it unloads gradually.
double Wheel::deflection(const LocalMotion &motion) const
{
  return parameters_.bilateral ? motion.u[0] : std::min(0., motion.u[0]);
}

void Wheel::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const double force = force_in_contact(motion.u[0], motion.v[0]) / parameters_.stiffness; // as a length, like u
  g[0]               = is_closed(history) ? force : std::min(force, -motion.u[0]);
}

std::vector<Quantity> Wheel::quantities() const
{
  return {{"force", "N"}, {"compression", "m"}};
}

double Wheel::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (i == 1)
    return -motion.u[0];
  double p;
  force(motion, history, &p);
  return p;
}

} // namespace gestell::mechanism
