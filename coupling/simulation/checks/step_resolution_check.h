#pragma once

#include "coupling/integration/events/finding.h"
#include "coupling/integration/integration_method.h"
#include "coupling/integration/system/local_forces.h"
#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/**
 * Steps that a load changes too fast for: of what happens between their ends methods see nothing, and a load of
 * 995 Hz acts like one of 5 Hz on steps of 1 ms.
 *
 * @throws std::invalid_argument for a harmonic load of two steps a period or fewer (of one, where the method carries
 *         such loads exactly, or controls its steps, of which this is the largest), with the step that is needed
 */
void require_steps_for_loads(const Machine &machine, const MethodOptions &method);

/**
 * The same of forces that are seen but badly, of all that depend on time by themselves, and of turning:
 *
 *     D(t) = |p(t) - linear between the ends of the step|,     R = max p - min p,     at the motion of the end,
 *
 * over up to 5000 steps, each at three instants.  There is a warning for a force with D > R/40 in a quarter of
 * these steps (a harmonic force then has fewer than ten steps in a period) or whose values at the ends of steps span
 * less than half of R, and for a rotor that turns by more than a tenth of a turn in a step while a force depends on its
 * angle.  Laws follow the motion, not their history, afterwards.
 *
 * @param last  the motion at the end of the run; v velocities [n], of which those of rotors count
 * @param outcome  gets a warning of each; none with controlled steps
 */
void check_step_resolution(Machine &machine, const MethodOptions &method, double begin, const LocalState &last,
                           const Eigen::VectorXd &v, RunOutcome &outcome);

} // namespace gestell::coupling
