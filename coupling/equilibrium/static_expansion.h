#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * State of a machine on the unreduced frame from that of the same machine on the reduced one: values of interface and
 * bodies are copied, the internal DOFs of the frame follow statically,
 *
 *     q2 = C22^-1 (f_s2 - C21 q1 - (M q'')_2),     q2' = -C22^-1 C21 q1',     q2'' = -C22^-1 C21 q1'',
 *
 * which is exact for a start in equilibrium (5.5.3/15; f_s2: weight of the frame).
 *
 * @param acceleration  q'' of the reduced machine [n], a rigid-body motion, for a start with inertia relief; empty:
 * none
 * @throws std::invalid_argument if the interfaces of both frames differ.
 */
InitialState expand_statically(const Machine &full, const Machine &reduced, const InitialState &state,
                               const Eigen::VectorXd &acceleration = {});

/// Accelerations of the interfaces of the reduced frame at the beginning of a motion [n]; others are zero or right,
/// too.
Eigen::VectorXd acceleration_of_interfaces(Machine &reduced, const InitialState &state);

} // namespace gestell::coupling
