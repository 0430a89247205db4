#include "mechanism/joints/joint_friction.h"

#include "mechanism/require.h"

#include <algorithm>

namespace gestell::mechanism
{

template <int k>
JointFriction<k>::JointFriction(const Parameters &parameters) : parameters_(parameters)
{
  parameters.friction.check("joint friction");
  parameters.load.check("joint friction");
  for (const double radius : parameters.radii)
    require(std::isfinite(radius) && radius >= 0., "joint friction", "radius [m]", radius, "zero or positive");
}

template <int k>
bool JointFriction<k>::turns() const
{
  return std::all_of(parameters_.radii.begin(), parameters_.radii.end(), [](double radius) { return radius > 0.; });
}

template <int k>
std::vector<Quantity> JointFriction<k>::quantities() const
{
  return {{"friction", turns() ? "N m" : "N"}, {"sliding_speed", "m/s"}};
}

template <int k>
double JointFriction<k>::quantity(int i, const LocalMotion &motion, const double *history) const
{
  double p[k], v2 = 0., p2 = 0.;
  this->force(motion, history, p);
  if (k == 1)
    return i == 0 ? p[0] : lever(0) * motion.v[0];
  for (int j = 0; j < k; ++j)
  {
    const double v = lever(j) * motion.v[j], on_surface = turns() ? p[j] : p[j] / lever(j);
    v2 += v * v;
    p2 += on_surface * on_surface;
  }
  return std::sqrt(i == 0 ? p2 : v2);
}

template class JointFriction<1>;
template class JointFriction<2>;
template class JointFriction<3>;

} // namespace gestell::mechanism
