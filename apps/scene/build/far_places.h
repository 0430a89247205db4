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

/// Known data of an interface and its faces.
struct PlacedFaces
{
  coupling::FaceBox      box;
  std::optional<Vector3> position; ///< of its node [m]; none: the middle of the faces
};

/**
 * Warnings of interface nodes and points of joints and elements that are far from the faces of their interface and
 * therefore connected by a long rigid lever, see coupling::FaceReach.  Distances along the axis of a guide and in a
 * contact plane are ignored.
 *
 * @param faces  by the name of the interface.
 */
std::vector<std::string> places_far_from_faces(const Scene &scene, const std::map<std::string, PlacedFaces> &faces);
std::vector<std::string> places_far_from_faces(const Scene &scene, const coupling::ReducedFrame &frame);
/// The same for the frame of the model; no warnings without a frame.
std::vector<std::string> places_far_from_faces(const Scene &scene, const coupling::MachineModel &machine);

} // namespace gestell::apps
