#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"

namespace gestell::apps
{

/// Attaches the unbalance of a rotor as an element "NAME unbalance": along e_1, the first global axis across the
/// rotor's axis a, and e_2 = a x e_1.
/// @throws std::invalid_argument for an unbalance beside a carrier that turns by any angle
void attach_unbalance(coupling::MachineModel &machine, const BodyRequest &rotor, const Vector3 &gravity);

} // namespace gestell::apps
