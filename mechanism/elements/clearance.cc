#include "mechanism/elements/clearance.h"

#include "mechanism/require.h"

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

void Clearance::start(const LocalMotion &motion, double *history) const
{
  history[0] = branch_at(motion.u[0], motion.v[0]);
}

void Clearance::engaged(const double *, double *K, double *D) const
{
  K[0] = parameters_.stiffness;
  D[0] = 0.;
}

double Clearance::stored_energy(const LocalMotion &motion, const double *history) const
{
  const double u      = motion.u[0];
  const Branch branch = motion.by_history ? branch_of(history) : branch_at(u, motion.v[0]);
  const double d      = branch == open ? 0. : side(branch) * u - parameters_.gap;
  return 0.5 * parameters_.stiffness * d * d;
}

std::vector<Guard> Clearance::guards(const double *history) const
{
  const Branch branch = branch_of(history);
  if (branch == open)
    return {{"contact_positive", Crossing::rising}, {"contact_negative", Crossing::falling}};
  const Guard separation{"separation", branch > 0 ? Crossing::falling : Crossing::rising};
  if (in_slack(branch))
    return {separation, {"contact_grip", Crossing::rising}};
  return {separation, {"contact_slack", Crossing::falling}};
}

void Clearance::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const auto &[gap, c, chi] = parameters_;
  const double u            = motion.u[0];
  const Branch branch       = branch_of(history);
  const double s            = side(branch);
  g[0]                      = u - s * gap;
  g[1]                      = branch == open ? u + gap : 1. + (chi * s) * motion.v[0];
}

void Clearance::transition(int i, const LocalMotion &, double *history) const
{
  switch (branch_of(history))
  {
  case open:
    history[0] = i == 0 ? contact_positive : contact_negative;
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
