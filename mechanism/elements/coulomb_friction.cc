#include "mechanism/elements/coulomb_friction.h"

#include "mechanism/require.h"

#include <cassert>
#include <cmath>

namespace gestell::mechanism
{

CoulombFriction::CoulombFriction(const Parameters &parameters)
    : parameters_(parameters), sliding_{parameters.kinetic_force, parameters.static_force, parameters.stribeck_speed,
                                        parameters.stribeck_exponent}
{
  const std::string name = "coulomb friction";
  sliding_.check(name);
  require(std::isfinite(parameters.belt_speed), name, "belt_speed [m/s]", parameters.belt_speed, "finite");
  require(std::isfinite(parameters.viscous) && parameters.viscous >= 0., name, "viscous [N s/m]", parameters.viscous,
          "zero or positive");
  if (parameters.load)
    parameters.load->check(name);
  for (const double level : parameters.engagement.levels())
    require(level >= 0. && level <= 1., name, "engagement", level, "between 0 and 1");
}

void CoulombFriction::engaged(const double *, double *K, double *D) const
{
  K[0] = 0.;
  D[0] = parameters_.viscous;
}

void CoulombFriction::start(const LocalMotion &motion, double *history) const
{
  parameters_.engagement.start(motion.t, history + 1);
  find_branch(motion, history);
}

void CoulombFriction::resume(const LocalMotion &motion, double *history) const
{
  parameters_.engagement.resume(motion.t, history + 1);
  find_branch(motion, history);
}

void CoulombFriction::find_branch(const LocalMotion &motion, double *history) const
{
  history[0] = parameters_.engagement.is_zero(history + 1) ? released : branch_at(motion.v[0]);
}

void CoulombFriction::follow_engagement(const LocalMotion &motion, double *history) const
{
  if (parameters_.engagement.is_zero(history + 1))
    history[0] = released;
  else if (branch_of(history) == released)
    history[0] = branch_at(motion.v[0]);
}

bool CoulombFriction::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  if (!parameters_.engagement.command(order, motion.t, history + 1))
    return false;
  follow_engagement(motion, history);
  return true;
}

void CoulombFriction::check_order(const SwitchCommand &order) const
{
  if (order.name == "set")
    require(order.level >= 0. && order.level <= 1., "coulomb friction", "engagement", order.level, "between 0 and 1");
}

bool CoulombFriction::holds(const double *history, double &rate) const
{
  rate = parameters_.belt_speed;
  return branch_of(history) == stick;
}

int CoulombFriction::n_own_guards(const double *history) const
{
  return branch_of(history) == stick ? 2 : branch_of(history) == released ? 0 : 1;
}

int CoulombFriction::n_guards(const double *history) const
{
  return n_own_guards(history) + parameters_.engagement.n_guards(history + 1);
}

std::vector<Guard> CoulombFriction::guards(const double *history) const
{
  std::vector<Guard> guards;
  switch (branch_of(history))
  {
  case slip_forward:
    guards = {{"stick", Crossing::falling}};
    break;
  case slip_backward:
    guards = {{"stick", Crossing::rising}};
    break;
  case stick:
    guards = {{"slip_forward", Crossing::falling}, {"slip_backward", Crossing::falling}};
    break;
  case released:
    break;
  }
  for (const Guard &guard : parameters_.engagement.guards(history + 1))
    guards.push_back(guard);
  return guards;
}

void CoulombFriction::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  parameters_.engagement.guard_values(motion.t, history + 1, g + n_own_guards(history));
  if (branch_of(history) == released)
    return;
  if (branch_of(history) != stick)
  {
    g[0] = motion.v[0] - parameters_.belt_speed;
    return;
  }
  assert(motion.p != nullptr);
  const double capacity = engagement(motion.t, true, history) * normal_force(motion.lambda) * parameters_.static_force;
  g[0]                  = capacity + motion.p[0];
  g[1]                  = capacity - motion.p[0];
}

void CoulombFriction::transition(int i, const LocalMotion &motion, double *history) const
{
  if (i < n_own_guards(history))
  {
    history[0] = branch_of(history) != stick ? stick : i == 0 ? slip_forward : slip_backward;
    return;
  }
  parameters_.engagement.transition(i - n_own_guards(history), motion.t, history + 1);
  follow_engagement(motion, history);
}

std::vector<Quantity> CoulombFriction::quantities() const
{
  return {{"force", "N"}, {"rate", "m/s"}};
}

double CoulombFriction::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (i == 1)
    return motion.v[0];
  if (!motion.by_history || branch_of(history) != stick)
    return resistance(motion, history);
  assert(motion.p != nullptr);
  return -motion.p[0];
}

} // namespace gestell::mechanism
