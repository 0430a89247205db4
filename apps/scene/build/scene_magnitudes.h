#pragma once

#include "apps/scene/file/expected_values.h"
#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "coupling/modes/modes.h"

#include <string>
#include <vector>

namespace gestell::apps
{

// Values that are valid but implausible for machines, typically because of a missing or wrong unit: they are compared
// with the size and the masses of the machine itself.  Ranges with their reasons: docs/reference/scene/magnitudes.md.

/// Diagonal [m] of the box around all positions in the scene; 0: it has no positions.
double machine_size(const Scene &scene, const coupling::MachineModel &machine);

/// "press.toml:12: element.rod.stiffness" for a body, an element or a joint and one of its keys.
std::string key_place(const Scene &scene, const std::string &object, const std::string &key);

/**
 * Largest plausible deflection of elastic parts, frame and supports under weights and loads, relative to the size of
 * the machine.  The softest parts, suspensions of vehicles and air springs, deflect by up to 0.05, metal below 0.005.
 */
constexpr double most_yielding = 0.05;

/// "at most 0.1 m, 0.05 of the size of the machine, ..."
std::string yielding_text(double size);

enum class Masses
{
  known,
  of_stand_in ///< the frame has not been computed
};

/// Checks before a run: clearances, radii of gyration, unbalance; with known masses also natural frequency and damping
/// ratio of each element, start-up time of each motor, and sag of the frame under its weight.
std::vector<UnexpectedValue> scene_magnitudes(const Scene &scene, const coupling::Machine &machine, Masses masses);

/// Checks of the frame's damping, from its modes.
std::vector<UnexpectedValue> magnitudes_of_modes(const Scene &scene, const std::vector<coupling::Mode> &of_frame);

} // namespace gestell::apps
