#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>

namespace gestell::coupling
{

/// An element that sticks to a motion that is already constrained.
struct StickingConflict
{
  std::string element; ///< its name in the scene; empty: there is none
  std::string words;   ///< the motion it constrains, what else constrains it, and the remedy
};

/**
 * Finds elements that stick initially and constrain a motion, w. q' = rate, that joints and other sticking elements
 * already constrain: w is a linear combination of their rows, so that all their forces are undefined.
 *
 * @param machine  its elements are initialised for this motion
 */
StickingConflict sticking_conflict(Machine &machine, const InitialState &initial);

} // namespace gestell::coupling
