#include "mechanism/elements/journal_bearing.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{

JournalBearing::JournalBearing(const Parameters &parameters)
    : parameters_(parameters), normal_({parameters.clearance, parameters.stiffness, parameters.dissipation,
                                        Clearance::Stops::above, parameters.exponent})
{
  const std::string name = "journal bearing";
  require(std::isfinite(parameters.clearance) && parameters.clearance > 0., name, "clearance [m]", parameters.clearance,
          "positive");
  require(std::isfinite(parameters.radius) && parameters.radius >= 0., name, "radius [m]", parameters.radius,
          "zero or positive");
  parameters.friction.check(name);
}

JournalBearing::Polar::Polar(const LocalMotion &motion)
{
  r    = std::hypot(motion.u[0], motion.u[1]);
  n1   = r > 0. ? motion.u[0] / r : 1.;
  n2   = r > 0. ? motion.u[1] / r : 0.;
  rate = n1 * motion.v[0] + n2 * motion.v[1];
}

void JournalBearing::start(const LocalMotion &motion, double *history) const
{
  const Polar polar(motion);
  normal_.start(polar.motion(motion), history);
}

/// Pressed along the eccentricity; across it the contact gives way.
void JournalBearing::engaged(const double *u, double *K, double *) const
{
  constexpr double at_rest[3] = {};
  const Polar      polar({0., u, at_rest, nullptr});
  double           k, d;
  normal_.engaged(&polar.r, &k, &d);
  const double n[] = {polar.n1, polar.n2};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      K[i + 3 * j] = k * n[i] * n[j];
}

double JournalBearing::stored_energy(const LocalMotion &motion, const double *history) const
{
  const Polar polar(motion);
  return normal_.stored_energy(polar.motion(motion), history);
}

double JournalBearing::stored_power(const LocalMotion &motion, const double *history) const
{
  const Polar polar(motion);
  return normal_.stored_power(polar.motion(motion), history);
}

double JournalBearing::penetration(const LocalMotion &motion) const
{
  return std::max(0., Polar(motion).r - parameters_.clearance);
}

Play JournalBearing::play(const double *u, const double *v, double *G) const
{
  Play play;
  play.n   = 2;
  play.gap = parameters_.clearance;
  std::fill_n(G, 6, 0.);
  for (int i = 0; i < 2; ++i)
  {
    play.s[i]    = u[i];
    play.rate[i] = v[i];
    G[i + 3 * i] = 1.;
  }
  return play;
}

void JournalBearing::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const Polar polar(motion);
  normal_.guard_values(polar.motion(motion), history, g);
}

void JournalBearing::transition(int i, const LocalMotion &motion, double *history) const
{
  const Polar polar(motion);
  normal_.transition(i, polar.motion(motion), history);
}

std::vector<Quantity> JournalBearing::quantities() const
{
  return {{"force", "N"},        {"normal_force", "N"},    {"friction_force", "N"},
          {"eccentricity", "m"}, {"contact_angle", "rad"}, {"sliding_speed", "m/s"}};
}

double JournalBearing::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const Polar polar(motion);
  double      p[3];
  force(motion, history, p);
  switch (i)
  {
  case 0:
    return std::hypot(p[0], p[1]);
  case 1:
    return -(p[0] * polar.n1 + p[1] * polar.n2);
  case 2:
    return p[1] * polar.n1 - p[0] * polar.n2;
  case 3:
    return polar.r;
  case 4:
    return std::atan2(motion.u[1], motion.u[0]);
  default:
    return polar.n1 * motion.v[1] - polar.n2 * motion.v[0] + parameters_.radius * motion.v[2];
  }
}

} // namespace gestell::mechanism
