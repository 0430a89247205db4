#pragma once

#include "coupling/machine/machine.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

struct InitialState
{
  double          t = 0.;
  Eigen::VectorXd q, v;            // [n]
  bool            settled = false; ///< in equilibrium: contacts are closed by the forces they carry

  std::vector<std::string> notes{}; ///< what a user should know of how it was found
};

/// What is known of a steady motion: `angles` [rad] and `speeds` [rad/s] of rotors; the balance of `driver` is not
/// demanded, it carries what the drive lacks.
struct SteadyStart
{
  std::vector<std::pair<std::string, double>> angles;
  std::vector<std::pair<std::string, double>> speeds;
  std::string                                 driver;
  double                                      t = 0.; ///< [s] at which forces that depend on time are taken
};

/**
 * State from which the machine runs on steadily for an instant (docs/theory/start.md): the frame rests, rotors turn as
 * given, sliders follow the closed elements kinematically, g(q) = 0, grad g . q' = 0, grad g . q'' = -q'^T g'' q'; the
 * positions are those of equilibrium with weights, element forces and the inertia of that motion; what sticks carries
 * no force,
 *
 *     M q'' + B q' + C q = f_t + W p(q, q', q'').
 *
 * @throws std::invalid_argument if angles and driver do not match, or if a motion is free and not balanced: it is
 * named; ConvergenceFailure if Newton finds no equilibrium.
 */
InitialState steady_start(Machine &machine, const SteadyStart &start);

} // namespace gestell::coupling
