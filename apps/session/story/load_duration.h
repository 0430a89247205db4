#pragma once

#include "apps/output/values/run_story.h"
#include "apps/session/prepared_machine.h"
#include "apps/session/story/local_modes.h"

#include <optional>
#include <vector>

namespace gestell::apps
{

/**
 * Duration of a force, from samples F(t).  It acts in the interval above 0.01 |F|_max that contains the peak, joined
 * with earlier intervals whose gap is shorter than a tenth of its duration (a bouncing tool).  The rise ends at 0.9 of
 * the peak.  The duration of the fall is extrapolated linearly from that between 0.9 and 0.1 of the peak.
 *
 * At events, which rows may miss, the force on both sides is also a sample; `row_step` is the largest interval between
 * samples.
 *
 * @return none for a force that acts at the first or last sample, or changes its sign
 */
std::optional<LoadDuration> load_duration(const std::vector<double> &t, const std::vector<double> &F);

/// Whether it has zero stiffness and damping in the configuration of the modes: a tool or load.
bool is_tool(const mechanism::Element &element);

/**
 * Residual vibration after a force falls linearly by dF within tau, relative to that after a sudden fall.  E is the
 * energy that remains in a mode v of frequency omega, with v^T M v = 1 and displacement u = w. v at the force:
 *
 *     factor = |sin(pi tau/T) / (pi tau/T)|,     E = 1/2 (factor u dF / omega)^2.
 *
 * Source: response of an undamped oscillator to a ramp; docs/how_to/case_press.md (2).
 */
double fall_factor(double fall_over_period);

/// Durations of every signal that is the force of an element without stiffness (a tool), with the modes it excites:
/// modes of the machine linearised at the state kept where the force begins to fall.
std::vector<LoadDuration> load_durations(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                         const Result &result, ModesOfRun &modes);

} // namespace gestell::apps
