#include "mechanism/elements/profile_force.h"

namespace gestell::mechanism
{

void ProfileForce::start(const LocalMotion &motion, double *history) const
{
  course_.start(motion.t, history);
}

void ProfileForce::resume(const LocalMotion &motion, double *history) const
{
  course_.resume(motion.t, history);
}

std::vector<Guard> ProfileForce::guards(const double *history) const
{
  return course_.guards(history);
}

void ProfileForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  course_.guard_values(motion.t, history, g);
}

void ProfileForce::transition(int i, const LocalMotion &motion, double *history) const
{
  course_.transition(i, motion.t, history);
}

bool ProfileForce::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  return !input_ && course_.command(order, motion.t, history);
}

std::vector<std::string> ProfileForce::command_names() const
{
  return input_ ? std::vector<std::string>() : CommandedProfile::commands();
}

std::vector<Quantity> ProfileForce::quantities() const
{
  return {{"force", "N"}, {"power", "W"}};
}

double ProfileForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const double p = -resistance(motion, history);
  return i == 1 ? p * motion.v[0] : p;
}

} // namespace gestell::mechanism
