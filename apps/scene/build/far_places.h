#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/frame/face_reach.h"
#include "coupling/machine/machine.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Warnings of points of joints and elements that lie far from the faces of the interface they act on, which a rigid
 * lever then carries, see coupling::far_from_faces.  The way along the axis of a guide and in a plane of contact does
 * not count.
 *
 * @param boxes  by the name of the interface.
 */
std::vector<std::string> places_far_from_faces(const Scene                                    &scene,
                                               const std::map<std::string, coupling::FaceBox> &boxes);
std::vector<std::string> places_far_from_faces(const Scene &scene, const coupling::MachineModel &machine);

} // namespace gestell::apps
