#include "mechanism/elements/common_tangents.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{

CommonTangents::CommonTangents(const std::string &name, const Parameters &parameters) : parameters_(parameters)
{
  const auto &[c, b, initial, circles, distance] = parameters_;
  require(std::isfinite(c) && c > 0., name, "stiffness [N/m]", c, "positive");
  require(std::isfinite(b) && b >= 0., name, "damping [N s/m]", b, "zero or positive");
  require(std::isfinite(initial), name, "initial deflection [m]", initial, "finite");
  require(std::isfinite(distance) && distance > std::abs(circles), name, "distance of the centres [m]", distance,
          "above " + std::to_string(std::abs(circles)) + ", so that its wheels have common tangents");
}

void CommonTangents::engaged(const double *u, double *K, double *D) const
{
  const int closest = u[1] > u[0] ? 1 : 0;
  for (int i = 0; i < 2; ++i)
    if (i == closest || u[i] + parameters_.initial > 0.)
    {
      K[4 * i] = parameters_.stiffness;
      D[4 * i] = parameters_.damping;
    }
}

void CommonTangents::stiffest(const double *, double *K, double *D) const
{
  K[0] = K[4] = parameters_.stiffness;
  D[0] = D[4] = parameters_.damping;
}

double CommonTangents::deflection(const LocalMotion &motion, int i) const
{
  return std::max(0., motion.u[i] + parameters_.initial);
}

double CommonTangents::stored_energy(const LocalMotion &motion, const double *) const
{
  const double left = deflection(motion, 0), right = deflection(motion, 1);
  return 0.5 * parameters_.stiffness * (left * left + right * right);
}

double CommonTangents::stored_power(const LocalMotion &motion, const double *) const
{
  return parameters_.stiffness * (deflection(motion, 0) * motion.v[0] + deflection(motion, 1) * motion.v[1]);
}

void CommonTangents::start(const LocalMotion &motion, double *history) const
{
  for (int i = 0; i < 2; ++i)
    history[i] = branch_at(motion.u[i], motion.v[i]);
}

/// Of a released tangent that of its force, then that of its deflection.
int CommonTangents::n_guards(const double *history) const
{
  return (branch_of(history, 0) == released ? 2 : 1) + (branch_of(history, 1) == released ? 2 : 1);
}

std::vector<Guard> CommonTangents::guards(const double *history) const
{
  std::vector<Guard> guards;
  for (int i = 0; i < 2; ++i)
  {
    const Branch      branch = branch_of(history, i);
    const std::string side   = i == 0 ? "left_" : "right_";
    guards.push_back({side + event(branch != loaded), branch == loaded ? Crossing::falling : Crossing::rising});
    if (branch == released)
      guards.push_back({side + "relaxed", Crossing::falling});
  }
  return guards;
}

void CommonTangents::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  for (int i = 0; i < 2; ++i)
  {
    const Branch branch = branch_of(history, i);
    const double d      = motion.u[i] + parameters_.initial;
    *g++                = branch == open ? d : load(motion.u[i], motion.v[i]);
    if (branch == released)
      *g++ = d;
  }
}

void CommonTangents::transition(int i, const LocalMotion &motion, double *history) const
{
  const int    of_left = branch_of(history, 0) == released ? 2 : 1, side = i < of_left ? 0 : 1;
  const Branch branch  = branch_of(history, side);
  const bool   relaxes = i - side * of_left == 1;
  if (branch == loaded)
    history[side] = parameters_.damping > 0. && motion.u[side] + parameters_.initial > 0. ? released : open;
  else
    history[side] = relaxes ? open : loaded;
}

std::array<double, 2> CommonTangents::loads(const LocalMotion &motion, const double *history) const
{
  double p[3];
  force(motion, history, p);
  return {-p[0], -p[1]};
}

double CommonTangents::sine(const LocalMotion &motion) const
{
  return std::clamp(parameters_.circles / (parameters_.distance + motion.u[2]), -1., 1.);
}

std::vector<Quantity> Belt::quantities() const
{
  return {{"left_force", "N"}, {"right_force", "N"}, {"hub_force", "N"}};
}

double Belt::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const auto [left, right] = loads(motion, history);
  if (i < 2)
    return i == 0 ? left : right;
  const double s = sine(motion);
  return std::hypot((left + right) * std::sqrt(1. - s * s), (left - right) * s);
}

/// At the described distance of the centres u_R = -u_L: they differ by the play.
Play GearPair::play(const double *u, const double *v, double *G) const
{
  Play play;
  play.n       = 1;
  play.gap     = std::max(0., -parameters().initial);
  play.s[0]    = 0.5 * (u[0] - u[1]);
  play.rate[0] = 0.5 * (v[0] - v[1]);
  G[0]         = 0.5;
  G[1]         = -0.5;
  return play;
}

std::vector<Quantity> GearPair::quantities() const
{
  return {{"force", "N"}, {"tangential_force", "N"}, {"radial_force", "N"}, {"axial_force", "N"}};
}

double GearPair::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const auto [left, right] = loads(motion, history);
  const double across = std::cos(helix_), cosine = std::abs(sine(motion)); // of the pressure angle
  if (i == 0)
    return left - right;
  if (i == 1)
    return (left - right) * across * cosine;
  return i == 2 ? (left + right) * across * std::sqrt(1. - cosine * cosine) : (left - right) * std::sin(helix_);
}

} // namespace gestell::mechanism
