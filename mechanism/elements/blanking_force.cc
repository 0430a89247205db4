#include "mechanism/elements/blanking_force.h"

#include "mechanism/require.h"

#include <algorithm>

namespace gestell::mechanism
{

BlankingForce::BlankingForce(const Parameters &parameters) : parameters_(parameters)
{
  const std::string name = "blanking force";
  const auto       &d    = parameters_;
  require(d.thickness > 0., name, "thickness [m]", d.thickness, "positive");
  require(d.cut_length > 0., name, "cut_length [m]", d.cut_length, "positive");
  require(d.shear_resistance > 0., name, "shear_resistance [Pa]", d.shear_resistance, "positive");
  require(d.peak_penetration > 0. && d.peak_penetration < 1., name, "peak_penetration", d.peak_penetration,
          "between 0 and 1");
  require(d.rise_exponent >= 1., name, "rise_exponent", d.rise_exponent, "at least 1");
  require(d.fracture_penetration > 0. && d.peak_penetration + d.fracture_penetration < 1., name, "fracture_penetration",
          d.fracture_penetration, "positive and, with peak_penetration, below 1");
  require(d.friction_share >= 0. && d.friction_share <= 1., name, "friction_share", d.friction_share,
          "between 0 and 1");
  F_max_             = d.shear_resistance * d.cut_length * d.thickness;
  z_m_               = d.peak_penetration * d.thickness;
  z_d_               = z_m_ + d.fracture_penetration * d.thickness;
  const double slope = d.rise_exponent * F_max_ / z_m_;
  require(d.elastic_stiffness > slope, name, "elastic_stiffness [N/m]", d.elastic_stiffness,
          "above the initial slope of the virgin curve, " + std::to_string(slope) + " N/m");
}

void BlankingForce::stiffest(const double *, double *K, double *) const
{
  *K = parameters_.elastic_stiffness;
}

double BlankingForce::lift_off(double z_max) const
{
  return z_max - virgin(virgin_branch(z_max), z_max) / parameters_.elastic_stiffness;
}

void BlankingForce::start(const LocalMotion &motion, double *history) const
{
  const double z = motion.u[0] - parameters_.contact_at;
  history[0]     = std::clamp(z, 0., parameters_.thickness);
  history[1]     = virgin_branch(z);
}

void BlankingForce::accept(const LocalMotion &motion, double *history) const
{
  // At a located contact the punch is a rounding error inside: no penetration to remember before the transition.
  const Branch branch = branch_of(history);
  if (motion.by_history && (branch == elastic || branch == apart))
    return;
  history[0] = std::max(history[0], std::min(motion.u[0] - parameters_.contact_at, parameters_.thickness));
}

double BlankingForce::stored_energy(const LocalMotion &motion, const double *history) const
{
  const double F = resistance(motion, history);
  return 0.5 * F * F / parameters_.elastic_stiffness;
}

double BlankingForce::stored_power(const LocalMotion &motion, const double *history) const
{
  double p, dp;
  tangent(motion, history, {1., 0., 0.}, &p, &dp);
  return p * dp / parameters_.elastic_stiffness * motion.v[0];
}

int BlankingForce::n_guards(const double *history) const
{
  const Branch branch = branch_of(history);
  return branch == through ? 0 : branch == apart ? 1 : 2;
}

std::vector<Guard> BlankingForce::guards(const double *history) const
{
  const Guard unload{"tool_unload", Crossing::falling};
  switch (branch_of(history))
  {
  case rise:
    return {unload, {"tool_force_maximum_passed", Crossing::rising}};
  case fracture:
    return {unload, {"fracture_branch_end", Crossing::rising}};
  case slug_friction:
    return {unload, {"sheet_severed", Crossing::rising}};
  case elastic:
    return {{"tool_release", Crossing::falling}, {"tool_reload", Crossing::rising}};
  case apart:
    return {{"tool_contact", Crossing::rising}};
  default:
    return {};
  }
}

void BlankingForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const double z = motion.u[0] - parameters_.contact_at, z_max = history[0];
  const Branch branch = branch_of(history);
  switch (branch)
  {
  case rise:
  case fracture:
  case slug_friction:
    g[0] = motion.v[0];
    g[1] = z - (branch == rise ? z_m_ : branch == fracture ? z_d_ : parameters_.thickness);
    break;
  case elastic:
    g[0] = z - lift_off(z_max);
    g[1] = z - z_max;
    break;
  case apart:
    g[0] = z - lift_off(z_max);
    break;
  default:
    break;
  }
}

void BlankingForce::transition(int i, const LocalMotion &motion, double *history) const
{
  constexpr Branch after[]  = {fracture, slug_friction, through}; // rise, fracture, slug friction
  const double     z        = motion.u[0] - parameters_.contact_at;
  const Branch     furthest = history[0] > 0. ? virgin_branch(history[0]) : rise; // branch of new material
  switch (branch_of(history))
  {
  case rise:
  case fracture:
  case slug_friction:
    history[0] = std::max(history[0], z);
    history[1] = i == 0 ? elastic : after[branch_of(history)];
    if (branch_of(history) == through) // severed for good, though located a rounding error before z = h
      history[0] = parameters_.thickness;
    break;
  case elastic:
    history[1] = i == 0 ? apart : furthest;
    break;
  case apart:
    history[1] = virgin(furthest, history[0]) > 0. ? elastic : furthest;
    break;
  default:
    break;
  }
}

std::vector<Quantity> BlankingForce::quantities() const
{
  return {{"force", "N"}, {"penetration", "m"}, {"largest_penetration", "m"}};
}

double BlankingForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const double z = motion.u[0] - parameters_.contact_at;
  return i == 0 ? resistance(motion, history) : i == 1 ? z : std::max(history[0], std::min(z, parameters_.thickness));
}

} // namespace gestell::mechanism
