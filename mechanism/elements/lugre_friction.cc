#include "mechanism/elements/lugre_friction.h"

namespace gestell::mechanism
{

LuGreFriction::LuGreFriction(const Parameters &parameters)
    : parameters_(parameters), sliding_{parameters.kinetic_force, parameters.static_force, parameters.stribeck_speed,
                                        parameters.stribeck_exponent}
{
  const std::string name = "lugre friction";
  const auto       &d    = parameters_;
  sliding_.check(name);
  if (d.load)
    d.load->check(name);
  require(d.kinetic_force > 0., name, "kinetic_force [N]", d.kinetic_force, "positive");
  require(std::isfinite(d.bristle_stiffness) && d.bristle_stiffness > 0., name, "bristle_stiffness [N/m]",
          d.bristle_stiffness, "positive");
  require(std::isfinite(d.bristle_damping) && d.bristle_damping >= 0., name, "bristle_damping [N s/m]",
          d.bristle_damping, "zero or positive");
  require(std::isfinite(d.viscous) && d.viscous >= 0., name, "viscous [N s/m]", d.viscous, "zero or positive");
}

void LuGreFriction::stiffest(const double *, double *K, double *D) const
{
  if (parameters_.load)
    return;
  K[0] = parameters_.bristle_stiffness;
  D[0] = parameters_.bristle_damping + parameters_.viscous;
}

void LuGreFriction::start(const LocalMotion &motion, double *history) const
{
  history[0] = motion.v[0] < 0. ? -1. : 1.;
}

double LuGreFriction::stored_energy(const LocalMotion &motion, const double *) const
{
  return parameters_.load ? 0. : 0.5 * motion.u[1] * motion.u[1] / parameters_.bristle_stiffness;
}

double LuGreFriction::stored_power(const LocalMotion &motion, const double *history) const
{
  if (parameters_.load)
    return 0.;
  double p[2];
  force(motion, history, p);
  return motion.u[1] / parameters_.bristle_stiffness * (p[1] - motion.u[1]) / lag();
}

std::vector<Guard> LuGreFriction::guards(const double *history) const
{
  return {{"reversal", history[0] < 0. ? Crossing::rising : Crossing::falling}};
}

void LuGreFriction::guard_values(const LocalMotion &motion, const double *, double *g) const
{
  g[0] = motion.v[0];
}

void LuGreFriction::transition(int, const LocalMotion &, double *history) const
{
  history[0] = -history[0];
}

std::vector<Quantity> LuGreFriction::quantities() const
{
  return {{"force", "N"}, {"rate", "m/s"}, {"deflection", "m"}};
}

double LuGreFriction::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (i == 2)
    return motion.u[1] / parameters_.bristle_stiffness;
  double p[2];
  force(motion, history, p);
  return i == 0 ? -p[0] : motion.v[0];
}

} // namespace gestell::mechanism
