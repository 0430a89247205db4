#include "mechanism/elements/coulomb_friction.h"

#include "mechanism/require.h"

#include <cassert>
#include <cmath>

namespace gestell::mechanism
{

CoulombFriction::CoulombFriction(const Parameters &parameters) : parameters_(parameters)
{
  const auto &[R, R0, v_b] = parameters_;
  const std::string name   = "coulomb friction";
  require(std::isfinite(R) && R >= 0., name, "kinetic_force [N]", R, "zero or positive");
  require(std::isfinite(R0) && R0 >= R, name, "static_force [N]", R0,
          "at least the kinetic force, " + std::to_string(R) + " N");
  require(std::isfinite(v_b), name, "belt_speed [m/s]", v_b, "finite");
}

void CoulombFriction::start(const LocalMotion &motion, double *history) const
{
  history[0] = branch_at(motion.v[0]);
}

bool CoulombFriction::holds(const double *history, double &rate) const
{
  rate = parameters_.belt_speed;
  return branch_of(history) == stick;
}

std::vector<Guard> CoulombFriction::guards(const double *history) const
{
  switch (branch_of(history))
  {
  case slip_forward:
    return {{"stick", Crossing::falling}};
  case slip_backward:
    return {{"stick", Crossing::rising}};
  default:
    return {{"slip_forward", Crossing::falling}, {"slip_backward", Crossing::falling}};
  }
}

void CoulombFriction::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  if (branch_of(history) != stick)
  {
    g[0] = motion.v[0] - parameters_.belt_speed;
    return;
  }
  assert(motion.p != nullptr);
  g[0] = parameters_.static_force + motion.p[0];
  g[1] = parameters_.static_force - motion.p[0];
}

void CoulombFriction::transition(int i, const LocalMotion &, double *history) const
{
  history[0] = branch_of(history) != stick ? stick : i == 0 ? slip_forward : slip_backward;
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
