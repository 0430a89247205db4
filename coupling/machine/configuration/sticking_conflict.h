#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>

namespace gestell::coupling
{

/// An element that sticks to a motion which others hold already.
struct StickingConflict
{
  std::string element; ///< by its name in the scene; empty: there is no such
  std::string words;   ///< what it holds, who holds it too, and the way out
};

/**
 * Looks for elements that stick at the start and hold, w . q' = rate, what joints and elements that stick hold already:
 * w is a linear combination of their rows, so that the forces of all of them are not defined.
 *
 * @param machine  its elements start at this motion
 */
StickingConflict sticking_conflict(Machine &machine, const InitialState &initial);

} // namespace gestell::coupling
