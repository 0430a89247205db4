#pragma once

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

/// "press.toml:12: element.rod.stiffness: " of a body, an element or a joint and one of its keys.
std::string key_place(const Scene &scene, const std::string &object, const std::string &key);

enum class Masses
{
  known,
  of_stand_in ///< the frame is not made yet
};

/// Before a run: play, radii of gyration, unbalance; with known masses natural frequency and damping ratio of each
/// element, start-up time of each motor, sag of the frame under its weight.  One warning each.
std::vector<std::string> scene_magnitudes(const Scene &scene, const coupling::Machine &machine, Masses masses);

/// Damping of the frame, by its modes.
std::vector<std::string> magnitudes_of_modes(const Scene &scene, const std::vector<coupling::Mode> &of_frame);

} // namespace gestell::apps
