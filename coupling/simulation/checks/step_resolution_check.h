#pragma once

#include "coupling/integration/events/finding.h"
#include "coupling/integration/integration_method.h"
#include "coupling/integration/system/local_forces.h"
#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/**
 * Rejects steps that are too long for a load: methods sample it only at the ends of steps (aliasing), so that with
 * steps of 1 ms a load of 995 Hz acts like one of 5 Hz.
 *
 * @throws std::invalid_argument for a harmonic load with two steps per period or fewer (with one, if the method
 *         integrates such loads exactly, or if the step is the upper limit of controlled steps), with the required step
 */
void require_steps_for_loads(const Machine &machine, const MethodOptions &method);

/**
 * Warns of forces that are sampled poorly, for all forces with explicit time dependence, and of fast rotation.  With
 * the motion at the end of the run let
 *
 *     D(t) = |p(t) - linear interpolation between the ends of the step|,     R = max p - min p
 *
 * over up to 5000 steps, each at three instants.  There is a warning for a force with D > R/40 in a quarter of these
 * steps (a harmonic force then has fewer than ten steps per period), or whose values at the ends of steps span less
 * than half of R.  There is also a warning for a rotor that rotates by more than a tenth of a revolution per step if a
 * force depends on its angle.  Afterwards laws follow the motion, not their history.
 *
 * @param last     the motion at the end of the run; v  velocities [n], of which those of rotors are used
 * @param outcome  receives the warnings; none with controlled steps
 */
void check_step_resolution(Machine &machine, const MethodOptions &method, double begin, const LocalState &last,
                           const Eigen::VectorXd &v, RunOutcome &outcome);

} // namespace gestell::coupling
