#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "coupling/modes/modes.h"

#include <string>
#include <vector>

namespace gestell::apps
{

// Warnings of valid but suspicious input, with its location in the scene.

/// Bodies on which only their weight acts.
std::vector<std::string> idle_bodies(const Scene &scene, const coupling::MachineModel &machine);

/// Joints that are farther from both bodies than the size of the machine.
std::vector<std::string> remote_joints(const Scene &scene, const coupling::MachineModel &machine);

/// Whether the supports of a frame leave rigid-body modes that elements would have to constrain.
bool may_float(const coupling::ReducedFrame &frame);

/// Warning about a frame that neither supports nor elements constrain, with the directions; empty if it is constrained.
/// @param modes  of the machine, from the lowest
std::string free_frame(const Scene &scene, const coupling::MachineModel &machine,
                       const std::vector<coupling::Mode> &modes);
/// The same for a scene with a [run] before its frame is computed, as far as it is known then: rigid_stand_in().
std::string floating_frame(const Scene &scene);

} // namespace gestell::apps
