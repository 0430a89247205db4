#include "apps/scene/build/far_places.h"

#include "apps/scene/build/build_measures.h"
#include "apps/scene/joints/joint_types.h"
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
  const Eigen::Vector3d axis   = vector(joint.axis).normalized();
  const Eigen::Matrix3d along  = axis * axis.transpose();
  const int             leaves = joint_type(joint.type).leaves;
  if (leaves == 2)
    return Eigen::Matrix3d::Identity() - along;
  if (leaves == 1)
    return along;
  return Eigen::Matrix3d::Zero();
}

/// Directions in which an interface guides bodies, which may act on it anywhere along their way.
Eigen::Matrix3d guided_directions(const Scene &scene, const std::string &marker)
{
  Eigen::Matrix3d free = Eigen::Matrix3d::Zero();
  for (const BodyRequest &body : scene.bodies)
    if (body.kind == coupling::BodyKind::slider && body.carrier == marker)
      free = vector(body.axis) * vector(body.axis).transpose();
  for (const JointRequest &joint : scene.joints)
    if (const Eigen::Matrix3d way = unconstrained_directions(joint);
        !way.isZero(0.) && (joint.from.marker == marker || joint.to.marker == marker))
      free = way;
  return free;
}

class FarPlaces
{
public:
  explicit FarPlaces(const std::map<std::string, PlacedFaces> &faces) : faces_(faces) {}

  void look_at(const PlaceRequest &place, const std::string &head, const Eigen::Matrix3d &free)
  {
    const std::string prefix = frame_prefix;
    if (!place.at || place.marker.rfind(prefix, 0) != 0)
      return;
    const auto faces = faces_.find(place.marker.substr(prefix.size()));
    if (faces != faces_.end())
      look_at(faces->second.box, *place.at, head + ": its point on \"" + place.marker + "\"", free);
  }

  void look_at(const coupling::FaceBox &box, const Vector3 &point, const std::string &what, const Eigen::Matrix3d &free)
  {
    if (const coupling::FaceReach reach = coupling::reach_of(box, vector(point), free); reach.far())
      warnings.push_back(what + " is " + short_text(reach.outside, 3) +
                         " m outside the faces of this interface, which are " + short_text(reach.size, 3) +
                         " m across; a rigid lever transmits its force to them. Check the point and its unit, or add "
                         "the actual faces to the interface");
  }

  std::vector<std::string> warnings;

private:
  const std::map<std::string, PlacedFaces> &faces_;
};

} // namespace

std::vector<std::string> places_far_from_faces(const Scene &scene, const std::map<std::string, PlacedFaces> &faces)
{
  FarPlaces far(faces);
  for (const auto &[name, own] : faces)
    if (own.position)
      far.look_at(own.box, *own.position, "frame.interface." + name + ".position: the node",
                  guided_directions(scene, frame_prefix + name));
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

std::vector<std::string> places_far_from_faces(const Scene &scene, const coupling::ReducedFrame &frame)
{
  std::map<std::string, PlacedFaces> faces;
  for (const fem::Interface &interface : frame.interfaces)
    faces[interface.name] = {coupling::box_of(interface.face), interface.position};
  return places_far_from_faces(scene, faces);
}

std::vector<std::string> places_far_from_faces(const Scene &scene, const coupling::MachineModel &machine)
{
  const coupling::ReducedFrame *frame = machine.reduced_frame();
  return frame ? places_far_from_faces(scene, *frame) : std::vector<std::string>();
}

} // namespace gestell::apps
