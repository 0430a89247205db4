#include "mechanism/elements/regularised_friction.h"

#include "mechanism/require.h"

#include <cmath>

namespace gestell::mechanism
{

RegularisedFriction::RegularisedFriction(const Parameters &parameters)
    : parameters_(parameters), sliding_{parameters.force,
                                        parameters.stribeck_speed > 0. ? parameters.static_force : parameters.force,
                                        parameters.stribeck_speed, parameters.stribeck_exponent}
{
  require(parameters.force >= 0., "friction", "force [N]", parameters.force, "zero or positive");
  require(parameters.speed > 0., "friction", "speed [m/s]", parameters.speed, "positive");
  require(std::isfinite(parameters.viscous) && parameters.viscous >= 0., "friction", "viscous [N s/m]",
          parameters.viscous, "zero or positive");
  sliding_.check("friction");
}

std::vector<Quantity> RegularisedFriction::quantities() const
{
  return {{"force", "N"}, {"rate", "m/s"}};
}

double RegularisedFriction::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? resistance(motion, history) : motion.v[0];
}

} // namespace gestell::mechanism
