#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"

namespace gestell::apps
{

/// The joints and switches of a scene, in the machine; bodies and elements must be there.
void add_joint(coupling::MachineModel &machine, const JointRequest &joint);
void add_switch(coupling::MachineModel &machine, const SwitchRequest &request);

/// Attaches a law that acts between two places, on the measures of its PairRequest.
void attach_between(coupling::MachineModel &machine, const ElementRequest &element);

} // namespace gestell::apps
