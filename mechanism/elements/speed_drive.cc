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
  const Measures<double> measures{motion.t, motion.u, motion.v, motion.a, motion.by_history};
  return wanted(measures, motion.by_history ? piece_of(history) : parameters_.speed.piece_at(motion.t));
}

void SpeedDrive::start(const LocalMotion &motion, double *history) const
{
  history[0] = static_cast<double>(parameters_.speed.piece_at(motion.t));
  history[1] = branch_at(wanted(motion, history));
}

int SpeedDrive::n_guards(const double *history) const
{
  return int(parameters_.speed.ends(piece_of(history))) + (!limited() ? 0 : branch_of(history) == 0 ? 2 : 1);
}

std::vector<Guard> SpeedDrive::guards(const double *history) const
{
  std::vector<Guard> guards;
  if (parameters_.speed.ends(piece_of(history)))
    guards.push_back({"next_segment", Crossing::rising});
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
  const std::size_t piece = piece_of(history);
  if (parameters_.speed.ends(piece))
    *g++ = motion.t - parameters_.speed.corner(piece);
  if (!limited())
    return;
  const double M     = wanted(Measures<double>{motion.t, motion.u, motion.v, motion.a, true}, piece);
  const double limit = parameters_.largest_torque;
  if (branch_of(history) != 0)
    g[0] = M - branch_of(history) * limit;
  else
  {
    g[0] = M - limit;
    g[1] = M + limit;
  }
}

void SpeedDrive::transition(int i, const LocalMotion &, double *history) const
{
  const bool ends = parameters_.speed.ends(piece_of(history));
  if (ends && i == 0)
    history[0] += 1.;
  else if (branch_of(history) != 0)
    history[1] = 0.;
  else
    history[1] = i == int(ends) ? 1. : -1.;
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
  {
    const std::size_t piece = motion.by_history ? piece_of(history) : parameters_.speed.piece_at(motion.t);
    return parameters_.speed.value(piece, motion.t) - (i == 3 ? motion.v[0] : 0.);
  }
  double p[2];
  force(motion, history, p);
  return i == 0 ? p[0] : p[0] * motion.v[0];
}

} // namespace gestell::mechanism
