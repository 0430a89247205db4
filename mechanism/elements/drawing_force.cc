#include "mechanism/elements/drawing_force.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{

DrawingForce::DrawingForce(const Parameters &parameters) : parameters_(parameters)
{
  const std::string name        = "drawing force";
  const auto &[F, c, at, depth] = parameters_;
  require(std::isfinite(F) && F > 0., name, "force [N]", F, "positive");
  require(std::isfinite(c) && c > 0., name, "stiffness [N/m]", c, "positive");
  require(std::isfinite(at), name, "contact_at [m]", at, "finite");
  require(depth > F / c, name, "depth [m]", depth, "above the rise, " + std::to_string(F / c) + " m");
}

void DrawingForce::stiffest(const double *, double *K, double *) const
{
  *K = parameters_.stiffness;
}

/// A punch that starts inside has drawn so far.
void DrawingForce::start(const LocalMotion &motion, double *history) const
{
  const double z = path(motion);
  history[0]     = std::max(0., z - rise());
  history[1]     = z <= 0. ? apart : z < rise() ? elastic : z < parameters_.depth ? flow : through;
}

void DrawingForce::accept(const LocalMotion &motion, double *history) const
{
  const double z = path(motion);
  if (motion.by_history ? branch_of(history) == flow : branch_of(history) != through)
    history[0] = motion.by_history ? z - rise() : std::max(history[0], z - rise());
}

double DrawingForce::stored_energy(const LocalMotion &motion, const double *history) const
{
  const double d      = elastic_force(path(motion), history);
  const Branch branch = branch_for(motion.by_history, history, d);
  const double F      = branch == elastic ? d : branch == flow ? parameters_.force : 0.;
  return 0.5 * F * F / parameters_.stiffness;
}

double DrawingForce::stored_power(const LocalMotion &motion, const double *history) const
{
  const double d      = parameters_.stiffness * (path(motion) - history[0]);
  const Branch branch = branch_for(motion.by_history, history, d);
  return branch == elastic ? d * motion.v[0] : 0.;
}

int DrawingForce::n_guards(const double *history) const
{
  const Branch branch = branch_of(history);
  return branch == through ? 0 : branch == apart ? 1 : branch == elastic ? 2 : 1 + int(ends());
}

std::vector<Guard> DrawingForce::guards(const double *history) const
{
  std::vector<Guard> guards;
  switch (branch_of(history))
  {
  case apart:
    return {{"tool_contact", Crossing::rising}};
  case elastic:
    return {{"tool_release", Crossing::falling}, {"flow_begins", Crossing::rising}};
  case flow:
    guards.push_back({"tool_unload", Crossing::falling});
    if (ends())
      guards.push_back({"drawn_through", Crossing::rising});
    return guards;
  default:
    return {};
  }
}

void DrawingForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const double z = path(motion);
  switch (branch_of(history))
  {
  case apart:
    g[0] = z - history[0];
    break;
  case elastic:
    g[0] = z - history[0];
    g[1] = z - history[0] - rise();
    break;
  case flow:
    g[0] = motion.v[0];
    if (ends())
      g[1] = z - parameters_.depth;
    break;
  default:
    break;
  }
}

void DrawingForce::transition(int i, const LocalMotion &motion, double *history) const
{
  switch (branch_of(history))
  {
  case apart:
    history[1] = elastic;
    break;
  case elastic:
    history[1] = i == 0 ? apart : flow;
    break;
  case flow:
    history[0] = path(motion) - rise();
    history[1] = i == 0 ? elastic : through;
    break;
  default:
    break;
  }
}

std::vector<Quantity> DrawingForce::quantities() const
{
  return {{"force", "N"}, {"path", "m"}, {"drawn", "m"}};
}

double DrawingForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (i < 2)
    return i == 0 ? resistance(motion, history) : path(motion);
  const double z      = path(motion);
  const Branch branch = branch_for(motion.by_history, history, elastic_force(z, history));
  return branch == flow ? z - rise() : history[0];
}

} // namespace gestell::mechanism
