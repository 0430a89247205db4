#include "mechanism/elements/speed_drive.h"

#include "mechanism/require.h"

#include <cmath>

namespace gestell::mechanism
{

SpeedDrive::SpeedDrive(const Parameters &parameters) : parameters_(parameters)
{
  const std::string name = "speed drive";
  const double      k_p = parameters.proportional_gain, k_i = parameters.integral_gain;
  require(std::isfinite(k_p) && k_p > 0., name, "proportional_gain [N m s/rad]", k_p, "positive");
  require(std::isfinite(k_i) && k_i >= 0., name, "integral_gain [N m/rad]", k_i, "zero or positive");
  require(parameters.largest_torque > 0., name, "largest_torque [N m]", parameters.largest_torque, "positive");
}

double SpeedDrive::lag() const
{
  return parameters_.integral_gain > 0. ? parameters_.proportional_gain / parameters_.integral_gain : 1.;
}

double SpeedDrive::wanted(const LocalMotion &motion, const double *history) const
{
  return wanted(Measures<double>{motion.t, motion.u, motion.v, motion.a, motion.by_history}, history);
}

void SpeedDrive::start(const LocalMotion &motion, double *history) const
{
  parameters_.speed.start(motion.t, history + 1);
  history[0] = branch_at(wanted(motion, history));
}

void SpeedDrive::resume(const LocalMotion &motion, double *history) const
{
  parameters_.speed.resume(motion.t, history + 1);
  history[0] = branch_at(wanted(motion, history));
}

int SpeedDrive::n_guards(const double *history) const
{
  return parameters_.speed.n_guards(history + 1) + (!limited() ? 0 : branch_of(history) == 0 ? 2 : 1);
}

std::vector<Guard> SpeedDrive::guards(const double *history) const
{
  std::vector<Guard> guards = parameters_.speed.guards(history + 1);
  if (!limited())
    return guards;
  if (branch_of(history) == 0)
  {
    guards.push_back({"limit_reached", Crossing::rising});
    guards.push_back({"limit_reached", Crossing::falling});
  }
  else
    guards.push_back({"limit_left", branch_of(history) > 0 ? Crossing::falling : Crossing::rising});
  return guards;
}

void SpeedDrive::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  parameters_.speed.guard_values(motion.t, history + 1, g);
  g += parameters_.speed.n_guards(history + 1);
  if (!limited())
    return;
  const double M     = wanted(Measures<double>{motion.t, motion.u, motion.v, motion.a, true}, history);
  const double limit = parameters_.largest_torque;
  if (branch_of(history) != 0)
    g[0] = M - branch_of(history) * limit;
  else
  {
    g[0] = M - limit;
    g[1] = M + limit;
  }
}

void SpeedDrive::transition(int i, const LocalMotion &motion, double *history) const
{
  const int of_course = parameters_.speed.n_guards(history + 1);
  if (i < of_course)
    parameters_.speed.transition(i, motion.t, history + 1);
  else if (branch_of(history) != 0)
    history[0] = 0.;
  else
    history[0] = i == of_course ? 1. : -1.;
}

bool SpeedDrive::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  return !parameters_.input && parameters_.speed.command(order, motion.t, history + 1);
}

std::vector<std::string> SpeedDrive::command_names() const
{
  return parameters_.input ? std::vector<std::string>() : CommandedProfile::commands();
}

std::vector<Quantity> SpeedDrive::quantities() const
{
  return {{"torque", "N m"}, {"power", "W"}, {"wanted_speed", "rad/s"}, {"speed_error", "rad/s"}, {"integral", "N m"}};
}

double SpeedDrive::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (i == 4)
    return motion.u[1];
  if (i == 2 || i == 3)
    return wanted_speed(motion.t, motion.by_history, history) - (i == 3 ? motion.v[0] : 0.);
  double p[2];
  force(motion, history, p);
  return i == 0 ? p[0] : p[0] * motion.v[0];
}

} // namespace gestell::mechanism
