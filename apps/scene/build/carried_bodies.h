#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Rejects a rotor or slider away from the axis of a carrier that rotates through large angles: in the model its
 * position and mass remain at the carrier's reference point, and its axis keeps its direction.  On the axis of the
 * carrier this is correct.
 *
 * @throws std::invalid_argument with both names and the remedy
 */
void check_carrier(const coupling::MachineModel &machine, const BodyRequest &body);

/// Warnings of masses that act at the reference point of a rotating interface, although they are placed far from it.
std::vector<std::string> carried_warnings(const Scene &scene, const coupling::MachineModel &machine);

} // namespace gestell::apps
