#pragma once

#include "apps/scene/scene.h"
#include "coupling/machine.h"

#include <memory>

namespace gestell::apps
{

/// The measures, joints and switches of a scene, in the machine; bodies and elements must be there.
void add_measures(coupling::Machine &machine, const Scene &scene);
void add_joint(coupling::Machine &machine, const JointRequest &joint);
void add_switch(coupling::Machine &machine, const SwitchRequest &request);

/// Attaches a law of one measure that acts on a measure of the scene.
void attach_on_measure(coupling::Machine &machine, const ElementRequest &element);

} // namespace gestell::apps
