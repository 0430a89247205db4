#include "apps/scene/joints/joint_keys.h"

#include "apps/scene/joints/compliance.h"

namespace gestell::apps
{

using coupling::BodyKind;

std::vector<Key> two_places()
{
  const auto at = [](const std::string &name, const std::string &meaning)
  { return key::vector(name, kind::length, meaning).by_default("its own point"); };
  return {key::named("from", "body, frame.INTERFACE, ground or marker"),
          key::named("to", "the second body, frame.INTERFACE, ground or marker"),
          at("at_from", "point of `from` in the reference configuration"),
          at("at_to", "point of `to` in the reference configuration")};
}

std::vector<Key> place_on_ground()
{
  std::vector<Key> places = two_places();
  places[1]               = places[1].by_default("ground");
  return places;
}

std::vector<Key> one_point()
{
  return joined({two_places(),
                 {key::vector("at", kind::length,
                              "common point of both in the reference configuration, instead of `at_from` and `at_to`")
                      .by_default("its own point")}});
}

std::vector<Key> point_joint(const std::vector<Key> &own)
{
  return joined({one_point(), own, compliance_keys()});
}

Key axis_key(const std::string &meaning)
{
  return key::direction("axis", meaning).into(&JointRequest::axis);
}

void check_two_places(const SceneTable &table, const PlaceRequest &from, const PlaceRequest &to)
{
  if (from.marker == to.marker)
    throw table.error("to", "is on '" + to.marker +
                                "', the body of `from`; a joint needs two bodies that can move relative to each other");
}

void read_two_places(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const bool one = table.declares("at") && table.has("at");
  joint.from     = names.place(table, "from", one ? "at" : "at_from");
  joint.to       = table.demands("to") ? names.place(table, "to", one ? "at" : "at_to")
                                       : names.place(table, "to", "at_to", "ground");
  check_two_places(table, joint.from, joint.to);
  table.fill(joint);
}

void read_joined_places(const SceneTable &table, const Names &names, JointRequest &joint)
{
  if (table.has("at") && (table.has("at_from") || table.has("at_to")))
    throw table.error("at", "already gives the point of the joint on both bodies; remove 'at_from' and 'at_to'");
  read_two_places(table, names, joint);
  if (!joint.to.at)
    joint.to.at = joint.from.at;
  if (!joint.from.at)
    joint.from.at = joint.to.at;
}

void read_one_point(const SceneTable &table, const Names &names, JointRequest &joint)
{
  read_joined_places(table, names, joint);
  if (!joint.from.at)
    throw table.error("needs 'at', the point of the joint in the reference configuration");
}

bool turns_about_own_axis(const BodyRequest *body)
{
  return body && (body->kind == BodyKind::rotor || body->kind == BodyKind::planar);
}

bool turns_freely(const Names &names, const std::string &marker)
{
  const BodyRequest *body = names.find_body(marker);
  return body && body->kind == BodyKind::rigid;
}

void refuse_in_space(const SceneTable &table, const std::string &key, const std::string &marker, const Names &names)
{
  if (turns_freely(names, marker))
    throw table.error(key, "'" + marker +
                               "' is a rigid body, whose revolutions are not counted; add a rotor that is connected to "
                               "it by a joint of type \"rigid\"");
}

} // namespace gestell::apps
