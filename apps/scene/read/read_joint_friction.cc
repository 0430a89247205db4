#include "apps/scene/read/read_joint_friction.h"

#include "apps/scene/language/quantity.h"
#include "apps/scene/read/joint_friction_request.h"
#include "apps/scene/read/read_contact.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

const Kind bristles_per_metre{"stiffness of the bristles per unit of the normal force", "20 1/mm", {-1, 0, 0}};
const Kind bristle_damping{"damping of the bristles per unit of the normal force", "3 s/m", {-1, 0, 1}};

/// Coefficients of both laws that stick, on the surface.
template <class Friction>
void read_coefficients(const SceneTable &own, Friction &friction)
{
  friction.kinetic_force     = own.value("coefficient");
  friction.static_force      = own.value_or("static", friction.kinetic_force);
  friction.stribeck_speed    = own.value_or("stribeck_speed", 0.);
  friction.stribeck_exponent = own.value_or("stribeck_exponent", friction.stribeck_exponent);
  if (friction.static_force < friction.kinetic_force)
    throw own.error("static", "is below 'coefficient'; what slides would hold more than what sticks");
}

mechanism::LuGreFriction::Parameters read_bristles(const SceneTable &own)
{
  mechanism::LuGreFriction::Parameters friction;
  read_coefficients(own, friction);
  if (friction.kinetic_force == 0.)
    throw own.error("coefficient", "must be positive: bristles without friction hold nothing; leave the friction out");
  friction.bristle_stiffness = own.value("bristle_stiffness");
  friction.bristle_damping   = own.value("bristle_damping");
  if (friction.static_force > friction.kinetic_force && friction.stribeck_speed == 0.)
    throw own.error("needs 'stribeck_speed', over which the coefficient falls from the static to the kinetic one");
  return friction;
}

} // namespace

Key joint_friction_key()
{
  std::vector<Key> keys = sliding_friction_key().keys;
  for (Key &key : keys)
    if (key.name == "stribeck_exponent")
      key = key.by_default("1; of `\"lugre\"` 2");
  return key::composed(
             "friction", Key::Form::coefficient, kind::number,
             joined({{key::choice("law", {"smooth", "dry", "lugre"}, true, "what happens near rest")},
                     keys,
                     {key::number("bristle_stiffness", bristles_per_metre, "of `\"lugre\"`")
                          .above_zero()
                          .by_default("demanded of `\"lugre\"`"),
                      key::number("bristle_damping", bristle_damping, "of `\"lugre\"`").from_zero().by_default(0.),
                      key::number("radius", kind::length, "of the pin or the ball")
                          .above_zero()
                          .by_default("demanded of joints that turn"),
                      key::number("length", kind::length,
                                  "of the guide of a prismatic or cylindrical joint, whose ends hold torques by forces "
                                  "that rub too")
                          .above_zero()
                          .by_default("they do not")}}),
             "by the force the joint carries, [see there](#friction-in-joints)")
      .from_zero()
      .by_default("none");
}

std::shared_ptr<const JointFrictionRequest> read_joint_friction(const SceneTable &table, JointType type)
{
  if (!table.has("friction"))
    return nullptr;
  const auto is_one_of = [type](std::initializer_list<JointType> types)
  { return std::find(types.begin(), types.end(), type) != types.end(); };
  const bool turns = is_one_of({JointType::revolute, JointType::spherical, JointType::cylindrical});
  if (!turns && !is_one_of({JointType::prismatic, JointType::in_plane}))
    throw table.error("friction", "is for joints of type \"revolute\", \"prismatic\", \"cylindrical\", \"spherical\" "
                                  "and \"in-plane\"; at others put an element of type \"friction\" beside the joint");
  if (turns && !table.is_table("friction"))
    throw table.error("friction", "needs the radius of the surface that slides; write { coefficient = 0.1, radius = "
                                  "\"20 mm\" }");
  JointFrictionRequest friction;
  if (!table.is_table("friction"))
  {
    friction.smooth = read_sliding_friction(table);
    return std::make_shared<JointFrictionRequest>(friction);
  }
  static const std::vector<Key> keys = {joint_friction_key()};
  const SceneTable              own  = table.declared(keys).table("friction");
  const std::string             law  = own.choice("law");
  if (law != "smooth" && !is_one_of({JointType::revolute, JointType::prismatic}))
    throw own.error("law", "is \"" + law +
                               "\", which is for revolute and prismatic joints, of one motion; leave it out: "
                               "\"smooth\" creeps instead of sticking");
  if (law == "dry")
    read_coefficients(own, friction.dry.emplace());
  else if (law == "lugre")
    friction.bristles = read_bristles(own);
  else
    friction.smooth = read_sliding_friction(table);
  if (turns)
    friction.radius = own.value("radius");
  if (is_one_of({JointType::prismatic, JointType::cylindrical}))
    friction.length = own.value_or("length", 0.);
  return std::make_shared<JointFrictionRequest>(friction);
}

} // namespace gestell::apps
