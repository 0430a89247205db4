#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "coupling/modes/modes.h"

#include <string>
#include <vector>

namespace gestell::apps
{

// Warnings of what is well formed and hardly meant, with its place in the scene.

/// Bodies on which nothing but their weight acts.
std::vector<std::string> idle_bodies(const Scene &scene, const coupling::MachineModel &machine);

/// Joints that lie farther from both bodies than the machine is wide.
std::vector<std::string> remote_joints(const Scene &scene, const coupling::MachineModel &machine);

/// Whether its supports leave a frame a motion that elements would have to hold.
bool may_float(const coupling::ReducedFrame &frame);

/// A frame that no support and no element holds, and where it can go; empty if it is held.
/// @param modes  of the machine, from the lowest
std::string free_frame(const Scene &scene, const coupling::MachineModel &machine,
                       const std::vector<coupling::Mode> &modes);
/// The same of a scene with a [run] before its frame is made, as far as it is known then: rigid_stand_in().
std::string floating_frame(const Scene &scene);

} // namespace gestell::apps
