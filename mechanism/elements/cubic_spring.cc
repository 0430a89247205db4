#include "mechanism/elements/cubic_spring.h"

#include "mechanism/require.h"

#include <cmath>

namespace gestell::mechanism
{

CubicSpring::CubicSpring(const Parameters &parameters) : parameters_(parameters)
{
  require(std::isfinite(parameters.stiffness), "cubic spring", "stiffness [N/m]", parameters.stiffness, "finite");
  require(std::isfinite(parameters.cubic), "cubic spring", "cubic [N/m^3]", parameters.cubic, "finite");
}

void CubicSpring::engaged(const double *u, double *K, double *D) const
{
  K[0] = parameters_.stiffness + 3. * parameters_.cubic * u[0] * u[0];
  D[0] = 0.;
}

double CubicSpring::stored_energy(const LocalMotion &motion, const double *) const
{
  const double square = motion.u[0] * motion.u[0];
  return (0.5 * parameters_.stiffness + 0.25 * parameters_.cubic * square) * square;
}

double CubicSpring::stored_power(const LocalMotion &motion, const double *) const
{
  const double u = motion.u[0];
  return (parameters_.stiffness + parameters_.cubic * u * u) * u * motion.v[0];
}

std::vector<Quantity> CubicSpring::quantities() const
{
  return {{"force", "N"}, {"displacement", "m"}};
}

double CubicSpring::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? resistance(motion, history) : motion.u[0];
}

} // namespace gestell::mechanism
