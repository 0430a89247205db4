#include "mechanism/elements/clearance.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{

Clearance::Clearance(const Parameters &parameters) : parameters_(parameters)
{
  const auto &[gap, c, chi] = parameters_;
  const std::string name    = "clearance";
  require(gap >= 0., name, "gap [m]", gap, "zero or positive");
  require(c > 0., name, "stiffness [N/m]", c, "positive");
  require(chi >= 0., name, "dissipation [s/m]", chi, "zero or positive");
}

// History: the side in contact, -1, 0 or 1.
void Clearance::start(const LocalMotion &motion, double *history) const
{
  const double u = motion.u[0];
  history[0]     = u > parameters_.gap ? 1. : u < -parameters_.gap ? -1. : 0.;
}

void Clearance::engaged(const double *, double *K, double *D) const
{
  K[0] = parameters_.stiffness;
  D[0] = 0.;
}

double Clearance::stored_energy(const LocalMotion &motion, const double *) const
{
  const double d = std::max(0., std::abs(motion.u[0]) - parameters_.gap);
  return 0.5 * parameters_.stiffness * d * d;
}

int Clearance::n_guards(const double *history) const
{
  return history[0] == 0. ? 2 : 1;
}

std::vector<Guard> Clearance::guards(const double *history) const
{
  if (history[0] == 0.)
    return {{"contact_positive", Crossing::rising}, {"contact_negative", Crossing::falling}};
  return {{"separation", history[0] > 0. ? Crossing::falling : Crossing::rising}};
}

void Clearance::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const double u = motion.u[0], gap = parameters_.gap;
  g[0] = history[0] < 0. ? u + gap : u - gap;
  if (history[0] == 0.)
    g[1] = u + gap;
}

void Clearance::transition(int i, const LocalMotion &, double *history) const
{
  history[0] = history[0] != 0. ? 0. : i == 0 ? 1. : -1.;
}

std::vector<Quantity> Clearance::quantities() const
{
  return {{"force", "N"}, {"displacement", "m"}};
}

double Clearance::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (i == 1)
    return motion.u[0];
  double p;
  force(motion, history, &p);
  return -p;
}

} // namespace gestell::mechanism
