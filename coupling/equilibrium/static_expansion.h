#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/**
 * State of a machine on the unreduced frame from that of the same machine on the reduced one: values of interface and
 * bodies are copied, the internal DOFs of the frame follow statically,
 *
 *     q2 = C22^-1 (f_s2 - C21 q1 - (M q'')_2),     q2' = -C22^-1 C21 q1',     q2'' = -C22^-1 C21 q1'',
 *
 * which is exact for a start in equilibrium (5.5.3/15; f_s2: weight of the frame; q'' of inertia relief, which moves
 * the frame as a rigid body, zero without it).
 *
 * @throws std::invalid_argument if the interfaces of both frames differ.
 */
InitialState expand_statically(const Machine &full, const Machine &reduced, const InitialState &state);

} // namespace gestell::coupling
