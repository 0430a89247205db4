#include "mechanism/elements/rope.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{

Rope::Rope(const Parameters &parameters) : parameters_(parameters)
{
  const auto &[c, b, slack] = parameters_;
  require(std::isfinite(c) && c > 0., "rope", "stiffness [N/m]", c, "positive");
  require(std::isfinite(b) && b >= 0., "rope", "damping [N s/m]", b, "zero or positive");
  require(std::isfinite(slack), "rope", "slack [m]", slack, "finite");
}

void Rope::engaged(const double *, double *K, double *D) const
{
  K[0] = parameters_.stiffness;
  D[0] = parameters_.damping;
}

double Rope::stored_energy(const LocalMotion &motion, const double *) const
{
  const double d = std::max(0., motion.u[0] - parameters_.slack);
  return 0.5 * parameters_.stiffness * d * d;
}

double Rope::stored_power(const LocalMotion &motion, const double *) const
{
  return parameters_.stiffness * std::max(0., motion.u[0] - parameters_.slack) * motion.v[0];
}

void Rope::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const auto &[c, b, slack] = parameters_;
  const double d            = motion.u[0] - slack;
  const double pull         = d + b / c * motion.v[0]; // F/c
  g[0]                      = is_closed(history) ? pull : std::min(d, pull);
}

std::vector<Quantity> Rope::quantities() const
{
  return {{"force", "N"}, {"elongation", "m"}};
}

double Rope::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? resistance(motion, history) : motion.u[0] - parameters_.slack;
}

} // namespace gestell::mechanism
