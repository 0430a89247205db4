#include "mechanism/joints/joint_friction.h"

#include "mechanism/require.h"

#include <algorithm>

namespace gestell::mechanism
{

template <int k>
JointFriction<k>::JointFriction(const Parameters &parameters) : parameters_(parameters)
{
  parameters.friction.check("joint friction");
  require(std::isfinite(parameters.radius) && parameters.radius >= 0., "joint friction", "radius [m]",
          parameters.radius, "zero or positive");
  require(std::isfinite(parameters.length) && parameters.length >= 0., "joint friction", "length [m]",
          parameters.length, "zero or positive");
  require(parameters.n_forces > 0, "joint friction", "number of forces", parameters.n_forces, "one or more");
}

template <int k>
double JointFriction<k>::normal_force(const double *lambda) const
{
  if (!lambda)
    return 0.;
  double forces = 0., torques = 0.;
  const auto &[friction, radius, n_forces, n_torques, length] = parameters_;
  for (int i = 0; i < n_forces; ++i)
    forces += lambda[i] * lambda[i];
  for (int i = n_forces; length > 0. && i < n_forces + n_torques; ++i)
    torques += lambda[i] * lambda[i];
  return std::max(std::sqrt(forces), length > 0. ? 2. / length * std::sqrt(torques) : 0.);
}

template <int k>
std::vector<Quantity> JointFriction<k>::quantities() const
{
  return {{"friction", parameters_.radius > 0. ? "N m" : "N"}, {"sliding_speed", "m/s"}};
}

template <int k>
double JointFriction<k>::quantity(int i, const LocalMotion &motion, const double *history) const
{
  double p[k], v2 = 0., p2 = 0.;
  this->force(motion, history, p);
  for (int j = 0; j < k; ++j)
  {
    v2 += motion.v[j] * motion.v[j];
    p2 += p[j] * p[j];
  }
  if (k == 1)
    return i == 0 ? p[0] : lever() * motion.v[0];
  return i == 0 ? std::sqrt(p2) : lever() * std::sqrt(v2);
}

template class JointFriction<1>;
template class JointFriction<2>;

} // namespace gestell::mechanism
