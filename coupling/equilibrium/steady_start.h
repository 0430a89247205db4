#pragma once

#include "coupling/machine/configuration/assembly.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

/// Known values of a steady motion: `angles` [rad] and `speeds` [rad/s] of rotors; the balance of `driver` is not
/// required, it supplies the missing driving force.
struct SteadyStart
{
  std::vector<std::pair<std::string, double>> angles;
  std::vector<std::pair<std::string, double>> speeds;
  std::string                                 driver;
  double                                      t = 0.; ///< [s] at which forces that depend on time are evaluated
};

/**
 * Initial state of a steady motion (docs/theory/start.md): the frame rests, rotors turn as given, sliders follow the
 * closed elements kinematically, g(q) = 0, grad g. q' = 0, grad g. q'' = -q'^T g'' q'; the positions are those of
 * equilibrium with weights, element forces and the inertia of that motion; sticking elements carry no force,
 *
 *     M q'' + B q' + C q = f_t + W p(q, q', q'').
 *
 * @throws std::invalid_argument if angles and driver do not match, or for an unbalanced free motion, with its name;
 * ConvergenceFailure if Newton's method finds no equilibrium.
 */
InitialState steady_start(Machine &machine, const SteadyStart &start);

/**
 * The counterpart of steady_start() with joints: joints satisfied in position and rate, all elastic parts in
 * equilibrium with the forces of the instant and with the inertia of their motion (docs/theory/start.md (15)),
 *
 *     M (a + S alpha) + B v + C q = f_t + W p(t, q, v, a + S alpha),     g(t, q) = 0.
 *
 * alpha [n_h] accelerates the coordinates with given speed: the imbalance of the drives.
 *
 * @param known  as for assemble(); coordinates with given speed keep their position, other positions are initial
 *   guesses
 * @throws std::invalid_argument without a given speed, or as assemble(), steady_motion() and static_equilibrium() do
 */
InitialState steady_start(Machine &machine, const KnownStart &known);

} // namespace gestell::coupling
