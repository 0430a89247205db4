#pragma once

#include <string>

namespace gestell::coupling
{

/// Interpolation of the elements' forces over a step in exact propagation.
enum class ForceRule
{
  average,    ///< constant: mean over the path of the step; second order, stable at every contact
  linear,     ///< linear between the ends; second order, stable up to omega_contact h = 2 sqrt(3)
  collocation ///< polynomial through Gauss points; order 2, 4, 6 or 8
};

/// "average", "linear" or "collocation": run.force of scenes.
inline std::string force_rule_name(ForceRule rule)
{
  return rule == ForceRule::average ? "average" : rule == ForceRule::linear ? "linear" : "collocation";
}

} // namespace gestell::coupling
