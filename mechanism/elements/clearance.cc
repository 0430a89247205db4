#include "mechanism/elements/clearance.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{

Clearance::Clearance(const Parameters &parameters) : parameters_(parameters)
{
  const auto &[gap, c, chi, stops, n] = parameters_;
  const std::string name              = stops == Stops::both ? "clearance" : "stop";
  if (stops == Stops::both)
    require(gap >= 0., name, "gap [m]", gap, "zero or positive");
  else
    require(std::isfinite(gap), name, "gap [m]", gap, "finite");
  require(c > 0., name, "stiffness [N/m^n]", c, "positive");
  require(std::isfinite(n) && n >= 1., name, "exponent", n, "at least 1");
  require(chi >= 0., name, "dissipation [s/m]", chi, "zero or positive");
}

double Clearance::dissipation_for(double e, double v)
{
  require(e > 0. && e <= 1., "stop", "restitution", e, "above 0 and at most 1");
  require(v > 0., "stop", "impact_speed [m/s]", v, "positive");
  // f(x) = (1 + e) x - ln(1 + x) + ln(1 - e x), x = chi v, rises as (1 - e^2) x^2/2 and has one zero before its pole.
  // Near e = 1 rounding hides it; there its first two terms, x = 3/2 (1 - e^2) / (1 + e^3), are right to (1 - e)^2.
  if (1. - e < 1e-4)
    return 1.5 * (1. - e * e) / (1. + e * e * e) / v;
  double low = 0.5 * (1. - e), high = 1. / e;
  for (int k = 0; k < 200; ++k)
  {
    const double x                                                        = 0.5 * (low + high);
    ((1. + e) * x - std::log1p(x) + std::log1p(-e * x) > 0. ? low : high) = x;
  }
  return 0.5 * (low + high) / v;
}

void Clearance::start(const LocalMotion &motion, double *history) const
{
  history[0] = branch_at(motion.u[0], motion.v[0]);
}

void Clearance::engaged(const double *u, double *K, double *D) const
{
  const auto &[gap, c, chi, stops, n] = parameters_;
  const double s                      = stops == Stops::below || (stops == Stops::both && u[0] < 0.) ? -1. : 1.;
  K[0]                                = n == 1. ? c : c * n * std::pow(std::max(0., s * u[0] - gap), n - 1.);
  D[0]                                = 0.;
}

double Clearance::stored_energy(const LocalMotion &motion, const double *history) const
{
  const double u      = motion.u[0];
  const Branch branch = branch_for(motion, history);
  const double d      = branch == open ? 0. : side(branch) * u - parameters_.gap;
  const double n      = parameters_.exponent;
  return n == 1. ? 0.5 * parameters_.stiffness * d * d : parameters_.stiffness / (n + 1.) * d * power(d);
}

double Clearance::stored_power(const LocalMotion &motion, const double *history) const
{
  const Branch branch = branch_for(motion, history);
  if (branch == open)
    return 0.;
  return parameters_.stiffness * power(side(branch) * motion.u[0] - parameters_.gap) * side(branch) * motion.v[0];
}

double Clearance::penetration(const LocalMotion &motion) const
{
  const Branch branch = branch_at(motion.u[0], motion.v[0]);
  return branch == open ? 0. : side(branch) * motion.u[0] - parameters_.gap;
}

/// For a stop below, s = -u.
Play Clearance::play(const double *u, const double *v, double *G) const
{
  const double direction = parameters_.stops == Stops::below ? -1. : 1.;
  Play         play;
  play.n       = 1;
  play.gap     = parameters_.gap;
  play.both    = parameters_.stops == Stops::both;
  play.s[0]    = direction * u[0];
  play.rate[0] = direction * v[0];
  G[0]         = direction;
  return play;
}

double Clearance::yielding(double force) const
{
  return std::pow(std::abs(force) / parameters_.stiffness, 1. / parameters_.exponent);
}

int Clearance::n_guards(const double *history) const
{
  return branch_of(history) == open && parameters_.stops != Stops::both ? 1 : 2;
}

std::vector<Guard> Clearance::guards(const double *history) const
{
  const Branch branch = branch_of(history);
  if (branch == open && parameters_.stops == Stops::both)
    return {{"contact_positive", Crossing::rising}, {"contact_negative", Crossing::falling}};
  if (branch == open)
    return {{"contact", parameters_.stops == Stops::above ? Crossing::rising : Crossing::falling}};
  const Guard separation{"separation", branch > 0 ? Crossing::falling : Crossing::rising};
  if (in_slack(branch))
    return {separation, {"contact_grip", Crossing::rising}};
  return {separation, {"contact_slack", Crossing::falling}};
}

void Clearance::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const auto &[gap, c, chi, stops, n] = parameters_;
  const double u                      = motion.u[0];
  const Branch branch                 = branch_of(history);
  const double s                      = branch == open ? (stops == Stops::below ? -1. : 1.) : side(branch);
  g[0]                                = u - s * gap;
  if (branch != open)
    g[1] = 1. + (chi * s) * motion.v[0];
  else if (stops == Stops::both)
    g[1] = u + gap;
}

void Clearance::transition(int i, const LocalMotion &, double *history) const
{
  switch (branch_of(history))
  {
  case open:
    history[0] = i == 0 && parameters_.stops != Stops::below ? contact_positive : contact_negative;
    break;
  case contact_positive:
    history[0] = i == 0 ? open : slack_positive;
    break;
  case contact_negative:
    history[0] = i == 0 ? open : slack_negative;
    break;
  case slack_positive:
    history[0] = i == 0 ? open : contact_positive;
    break;
  case slack_negative:
    history[0] = i == 0 ? open : contact_negative;
    break;
  }
}

std::vector<Quantity> Clearance::quantities() const
{
  return {{"force", "N"}, {"displacement", "m"}};
}

double Clearance::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? resistance(motion, history) : motion.u[0];
}

} // namespace gestell::mechanism
