#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/frame/face_reach.h"
#include "coupling/machine/machine.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// What is known of an interface and its faces.
struct PlacedFaces
{
  coupling::FaceBox      box;
  std::optional<Vector3> position; ///< of its node [m]; none: the middle of the faces
};

/**
 * Warnings of nodes of interfaces, points of joints and elements that lie far from the faces of their interface, which
 * a rigid lever then carries, see coupling::FaceReach.  The way along the axis of a guide and in a plane of
 * contact does not count.
 *
 * @param faces  by the name of the interface.
 */
std::vector<std::string> places_far_from_faces(const Scene &scene, const std::map<std::string, PlacedFaces> &faces);
std::vector<std::string> places_far_from_faces(const Scene &scene, const coupling::ReducedFrame &frame);
/// Of the frame that it has; none: no warnings.
std::vector<std::string> places_far_from_faces(const Scene &scene, const coupling::MachineModel &machine);

} // namespace gestell::apps
