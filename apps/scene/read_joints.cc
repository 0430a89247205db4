#include "apps/scene/read_joints.h"

#include "apps/scene/relative_motion.h"
#include "coupling/nearest_name.h"
#include "mechanism/joints/motion_law.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

using Form = mechanism::RelativeMeasure::Form;

/// A name of its own among all that signals refer to.
void check_new_name(const SceneTable &table, const Names &names, const Scene &scene)
{
  check_thing_name(table);
  const std::string name = table.name();
  if (names.find_body(name))
    throw table.error("a body has the name '" + name + "' too; signals could not tell them apart");
  if (scene.element_places.count(name))
    throw table.error("the name '" + name + "' is used at " + scene.element_places.at(name) +
                      " too; signals could not tell them apart");
}

void check_two_places(const SceneTable &table, const PlaceRequest &from, const PlaceRequest &to)
{
  if (from.marker == to.marker)
    throw table.error("to",
                      "lies on '" + to.marker + "' like `from`; it needs two bodies that can move against each other");
}

double dot(const Vector3 &a, const Vector3 &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

MeasureRequest read_measure(const SceneTable &table, const Names &names)
{
  MeasureRequest measure;
  measure.name           = table.name();
  measure.place          = table.place();
  const std::string type = table.choice("type", {"distance", "along", "inclination"}, "");
  PlaceRequest      from = names.place(table, "from", "at_from"), to = names.place(table, "to", "at_to", "ground");
  if (from.marker == to.marker)
    throw table.error("to", "lies on '" + to.marker + "' like `from`; what is measured would never change");
  measure.unit   = type == "inclination" ? "rad" : "m";
  measure.first  = from;
  measure.second = to;
  if (type == "distance")
    measure.form = Form::distance;
  else if (type == "along") // motion of `from` against `to`
  {
    measure.form = Form::along;
    measure.a    = table.direction("direction");
    std::swap(measure.first, measure.second);
  }
  else
  {
    measure.form = Form::inclination;
    measure.a    = table.direction("zero");
    measure.b    = table.direction("towards");
    if (std::abs(dot(measure.a, measure.b)) > 1e-9)
      throw table.error("towards", "must be at right angles to 'zero': the angle grows from there to here");
  }
  return measure;
}

/// Length that moves: at constant speed, or until it is braked.
std::shared_ptr<const mechanism::MotionLaw> read_motion(const SceneTable &table)
{
  using mechanism::BrakedMotion;
  const double speed = table.number("speed", kind::speed);
  const auto   brake = table.optional_table("brake");
  if (!brake)
    return std::make_shared<mechanism::ConstantSpeed>(speed);
  BrakedMotion::Parameters motion;
  motion.speed             = speed;
  const std::string family = brake->choice("family", {"linear", "cosine", "shaped"}, "linear");
  motion.family            = family == "linear"   ? BrakedMotion::Family::linear
                             : family == "cosine" ? BrakedMotion::Family::cosine
                                                  : BrakedMotion::Family::shaped;
  motion.duration          = brake->positive("duration", kind::time);
  if (family == "shaped")
    for (const auto &ramp : brake->table_array("ramps"))
      motion.ramps.push_back({ramp.number("share", kind::number), ramp.not_negative("delay", kind::time, 0.)});
  return checked(*brake, [&] { return std::make_shared<BrakedMotion>(motion); });
}

struct JointName
{
  const char *name;
  JointType   type;
};
constexpr JointName joint_names[] = {{"revolute", JointType::revolute}, {"spherical", JointType::spherical},
                                     {"rigid", JointType::rigid},       {"prismatic", JointType::prismatic},
                                     {"in-plane", JointType::in_plane}, {"distance", JointType::distance},
                                     {"gear", JointType::gear}};

JointRequest read_joint(const SceneTable &table, const Names &names)
{
  JointRequest joint;
  joint.name  = table.name();
  joint.place = table.place();
  std::vector<std::string> types;
  for (const JointName &known : joint_names)
    types.push_back(known.name);
  const std::string type = table.choice("type", types, "");
  for (const JointName &known : joint_names)
    if (known.name == type)
      joint.type = known.type;
  const bool together =
      joint.type == JointType::revolute || joint.type == JointType::spherical || joint.type == JointType::rigid;
  const bool one_point = table.has("at");
  if (one_point && (table.has("at_from") || table.has("at_to")))
    throw table.error("at", "says where the joint is on both bodies; leave out 'at_from' and 'at_to'");
  if (one_point && joint.type == JointType::distance)
    throw table.error("at", "is one point, but a distance lies between two; give 'at_from' and 'at_to'");
  joint.from = names.place(table, "from", one_point ? "at" : "at_from");
  joint.to   = names.place(table, "to", one_point ? "at" : "at_to");
  check_two_places(table, joint.from, joint.to);
  if (together && !joint.from.at && !joint.to.at)
    throw table.error("needs 'at', the point of the joint in the position the scene describes");
  // One place tells the other.
  if (joint.type != JointType::distance && joint.from.at && !joint.to.at)
    joint.to.at = joint.from.at;
  if (joint.type != JointType::distance && joint.to.at && !joint.from.at)
    joint.from.at = joint.to.at;
  if (joint.type == JointType::prismatic || joint.type == JointType::in_plane)
    joint.axis = table.direction("axis");
  if (joint.type == JointType::gear)
    joint.ratio = table.number("ratio", kind::number);
  if (joint.type == JointType::distance)
  {
    if (table.has("length"))
      joint.length = table.positive("length", kind::length);
    if (const auto motion = table.optional_table("motion"))
      joint.law = read_motion(*motion);
  }
  return joint;
}

} // namespace

void read_places(const SceneTable &scene, Names &names, Scene &result)
{
  for (const auto &table : scene.tables("place"))
  {
    check_thing_name(table);
    if (names.find_body(table.name()))
      throw table.error("a body has the name '" + table.name() + "' too; 'from' and 'to' could not tell them apart");
    names.add_place(table.name(), {names.marker(table, "on"), table.vector("at", kind::length)});
  }
  for (const auto &table : scene.tables("measure"))
  {
    check_new_name(table, names, result);
    result.measures.push_back(read_measure(table, names));
    result.element_places[table.name()] = table.place();
    names.add_measure(result.measures.back());
  }
}

void read_joints(const SceneTable &scene, const Names &names, Scene &result)
{
  for (const auto &table : scene.tables("joint"))
  {
    check_new_name(table, names, result);
    result.joints.push_back(read_joint(table, names));
    result.element_places[table.name()] = table.place();
  }
}

void read_switches(const SceneTable &scene, Scene &result)
{
  for (const auto &table : scene.tables("switch"))
  {
    check_thing_name(table);
    SwitchRequest own;
    own.place          = table.place();
    own.request.name   = table.name();
    own.request.signal = table.text("when");
    const bool above   = table.has("above");
    if (above == table.has("below"))
      throw table.error("needs 'above' or 'below', the value at which it is thrown");
    own.request.crossing = above ? coupling::GuardCrossing::rising : coupling::GuardCrossing::falling;
    own.level            = table.quantity(above ? "above" : "below");
    own.request.level    = own.level.value;
    own.request.element  = table.text("tell");
    own.request.order    = table.text("order");
    result.switches.push_back(own);
  }
}

} // namespace gestell::apps
