#pragma once

#include "apps/scene/file/expected_values.h"
#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "coupling/modes/modes.h"

#include <string>
#include <vector>

namespace gestell::apps
{

// Values that a scene may have and machines hardly do, as a unit that was forgotten or mistaken makes them: compared
// with the size and the masses of the machine itself.  Ranges with their reasons: docs/scene/magnitudes.md.

/// Diagonal [m] of the box of all that the scene places in space; 0: nothing has a place.
double machine_size(const Scene &scene, const coupling::MachineModel &machine);

/// "press.toml:12: element.rod.stiffness" of a body, an element or a joint and one of its keys.
std::string key_place(const Scene &scene, const std::string &object, const std::string &key);

/**
 * Of the size of the machine: what its elastic parts, its frame and its supports yield by under weights and loads.
 * The softest of them, suspensions of vehicles and air springs, yield by up to 0.05; metal is strained below 0.005.
 */
constexpr double most_yielding = 0.05;

/// "at most 0.1 m, 0.05 of the size of the machine, ..."
std::string yielding_text(double size);

enum class Masses
{
  known,
  of_stand_in ///< the frame is not made yet
};

/// Before a run: play, radii of gyration, unbalance; with known masses natural frequency and damping ratio of each
/// element, start-up time of each motor, sag of the frame under its weight.
std::vector<UnexpectedValue> scene_magnitudes(const Scene &scene, const coupling::Machine &machine, Masses masses);

/// Damping of the frame, by its modes.
std::vector<UnexpectedValue> magnitudes_of_modes(const Scene &scene, const std::vector<coupling::Mode> &of_frame);

} // namespace gestell::apps
