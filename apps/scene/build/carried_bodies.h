#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Refuses a rotor or slider whose carrier turns by any angle where it would have to be carried round: its place and its
 * mass stay at the carrier's reference point, its axis keeps its direction.  On the axis of the carrier it is right.
 *
 * @throws std::invalid_argument naming both and the way out
 */
void check_carrier(const coupling::MachineModel &machine, const BodyRequest &body);

/// Where a mass counts at the reference point of an interface that turns, but is described far from it.
std::vector<std::string> carried_warnings(const Scene &scene, const coupling::MachineModel &machine);

} // namespace gestell::apps
