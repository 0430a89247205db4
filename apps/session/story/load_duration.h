#pragma once

#include "apps/output/values/run_story.h"
#include "apps/session/prepared_machine.h"
#include "apps/session/story/local_modes.h"

#include <optional>
#include <vector>

namespace gestell::apps
{

/**
 * How long a force acts, from samples F(t): the piece above 0.01 |F|_max that holds the peak, with pieces before it
 * that are parted from it by less than a tenth of its duration (the tool bounces); how long it rises to 0.9 of
 * the peak; and how long a fall from there to 0.1 would last as a whole, were it even.
 *
 * Of events, which the rows may lie far from, the force on both sides is a sample, too; `row_step` tells how far apart
 * they lie.
 *
 * @return none of a force that acts at the begin or at the end, or changes its sign
 */
std::optional<LoadDuration> load_duration(const std::vector<double> &t, const std::vector<double> &F);

/// Whether it has no stiffness where the modes are found: tools and loads, not springs and contacts that hold.
bool is_tool(const mechanism::Element &element);

/**
 * Free vibration behind a force that falls evenly by dF within tau, beside that of a sudden fall; a mode v of frequency
 * omega, with v^T M v = 1 and the displacement u = w . v of the force, is left with the energy E:
 *
 *     factor = |sin(pi tau/T) / (pi tau/T)|,     E = 1/2 (factor u dF / omega)^2.
 *
 * Source: response of an undamped oscillator to a ramp; docs/press.md (2).
 */
double fall_factor(double fall_over_period);

/// Of every signal that is the force of an element without stiffness (a tool), with the modes it acts on: those of the
/// machine as it stands where the force begins to fall, of a state kept there.
std::vector<LoadDuration> load_durations(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                         const Result &result, ModesOfRun &modes);

} // namespace gestell::apps
