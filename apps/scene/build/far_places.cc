#include "apps/scene/build/far_places.h"

#include "apps/scene/build/build_measures.h"
#include "fem/values/number_text.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

constexpr const char *frame_prefix = "frame.";

/// Directions in which the point of a joint may lie anywhere: onto them.
Eigen::Matrix3d unconstrained_directions(const JointRequest &joint)
{
  const Eigen::Vector3d axis = vector(joint.axis).normalized();
  switch (joint.type)
  {
  case JointType::prismatic:
  case JointType::cylindrical:
    return axis * axis.transpose();
  case JointType::in_plane:
    return Eigen::Matrix3d::Identity() - axis * axis.transpose();
  default:
    return Eigen::Matrix3d::Zero();
  }
}

class FarPlaces
{
public:
  explicit FarPlaces(const std::map<std::string, coupling::FaceBox> &boxes) : boxes_(boxes) {}

  void look_at(const PlaceRequest &place, const std::string &head, const Eigen::Matrix3d &free)
  {
    const std::string prefix = frame_prefix;
    if (!place.at || place.marker.rfind(prefix, 0) != 0)
      return;
    const auto box = boxes_.find(place.marker.substr(prefix.size()));
    if (box == boxes_.end())
      return;
    const auto [outside, size] = coupling::reach_of(box->second, vector(*place.at), free);
    if (outside <= coupling::far_from_faces * size)
      return;
    warnings.push_back(head + ": its point on \"" + place.marker + "\" lies " + short_text(outside, 3) +
                       " m outside of the faces of this interface, which are " + short_text(size, 3) +
                       " m across; a rigid lever carries its force to them. Check the point and its unit, or give the "
                       "interface the faces that carry it");
  }

  std::vector<std::string> warnings;

private:
  const std::map<std::string, coupling::FaceBox> &boxes_;
};

} // namespace

std::vector<std::string> places_far_from_faces(const Scene                                    &scene,
                                               const std::map<std::string, coupling::FaceBox> &boxes)
{
  FarPlaces far(boxes);
  for (const JointRequest &joint : scene.joints)
    for (const PlaceRequest *place : {&joint.from, &joint.to})
      far.look_at(*place, joint.place + ": joint \"" + joint.name + "\"", unconstrained_directions(joint));
  for (const ElementRequest &element : scene.elements)
  {
    std::vector<const PlaceRequest *> places;
    if (element.pair)
      places = {&element.pair->from, &element.pair->to};
    if (element.own)
      places = {&element.own->first, &element.own->second};
    for (const PlaceRequest *place : places)
      far.look_at(*place, scene.element_places.at(element.name) + ": element \"" + element.name + "\"",
                  Eigen::Matrix3d::Zero());
  }
  return std::move(far.warnings);
}

std::vector<std::string> places_far_from_faces(const Scene &scene, const coupling::MachineModel &machine)
{
  std::map<std::string, coupling::FaceBox> boxes;
  if (const coupling::ReducedFrame *frame = machine.reduced_frame())
    for (const fem::Interface &interface : frame->interfaces)
      boxes[interface.name] = coupling::box_of(interface.face);
  return places_far_from_faces(scene, boxes);
}

} // namespace gestell::apps
