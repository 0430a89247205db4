#pragma once

#include "coupling/integration/step/implicit_step.h"

#include <string>

namespace gestell::coupling
{

enum class Method
{
  bdf,
  newmark,
  wilson,
  hht,
  generalised_alpha,
  central_difference,
  exact ///< linear base system carried exactly, forces of the elements interpolated
};

/// How exact propagation takes the forces of the elements over a step.
enum class ForceRule
{
  average,    ///< constant: mean along the way of the step; second order, stable at every contact
  linear,     ///< linear between the ends; second order, stable up to omega_contact h = 2 sqrt(3)
  collocation ///< polynomial through Gauss points; order 2, 4, 6 or 8
};

/// A method of integration with all its parameters; those of other methods are not looked at.
struct MethodOptions
{
  Method        method       = Method::bdf;
  int           order        = 2;     ///< bdf: 1..6, the highest with a tolerance; exact by collocation: 2, 4, 6, 8
  double        beta         = 0.25;  ///< newmark, >= 0
  double        gamma        = 0.5;   ///< newmark
  double        theta        = 1.4;   ///< wilson, >= 1
  double        alpha        = -0.05; ///< hht, in [-1/3, 0]
  double        rho_inf      = 0.8;   ///< generalised alpha, in [0, 1]
  ForceRule     force        = ForceRule::collocation;
  double        step         = 0.; ///< [s]; fixed, or the largest one if a tolerance is given
  double        tolerance    = 0.; ///< of the local error, relative to the scales of the motion; 0: fixed step
  int           max_halvings = 10; ///< of the step when Newton fails
  NewtonOptions newton;
};

/// Whether the error of steps is controlled, not their length fixed.
inline bool controlled(const MethodOptions &options)
{
  return options.tolerance > 0.;
}

/// "BDF 2", "generalised alpha 0.8", "exact, collocation 6"
std::string method_name(const MethodOptions &options);

/// @throws std::invalid_argument naming the parameter, its value and what it may be
void check_method(const MethodOptions &options);

} // namespace gestell::coupling
