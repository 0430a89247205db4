#include "mechanism/elements/profile_force.h"

namespace gestell::mechanism
{

void ProfileForce::start(const LocalMotion &motion, double *history) const
{
  history[0] = static_cast<double>(profile_.piece_at(motion.t));
}

std::vector<Guard> ProfileForce::guards(const double *history) const
{
  if (!profile_.ends(piece_of(history)))
    return {};
  return {{"next_segment", Crossing::rising}};
}

void ProfileForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  g[0] = motion.t - profile_.corner(piece_of(history));
}

void ProfileForce::transition(int, const LocalMotion &, double *history) const
{
  history[0] += 1.;
}

std::vector<Quantity> ProfileForce::quantities() const
{
  return {{"force", "N"}, {"torque", "N m"}, {"power", "W"}};
}

double ProfileForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const double p = -resistance(motion, history);
  return i == 2 ? p * motion.v[0] : p;
}

} // namespace gestell::mechanism
