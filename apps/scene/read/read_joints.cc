#include "apps/scene/read/read_joints.h"

#include "apps/scene/read/joint_axes.h"
#include "apps/scene/read/joint_keys.h"
#include "apps/scene/read/measure_order.h"
#include "apps/scene/read/read_compliance.h"
#include "apps/scene/read/read_function.h"
#include "apps/scene/read/read_joint_friction.h"
#include "apps/scene/read/read_motion.h"
#include "apps/scene/read/read_scalars.h"
#include "apps/scene/read/relative_motion.h"
#include "fem/values/vector3.h"

#include <Eigen/Geometry>

#include <cmath>

namespace gestell::apps
{
namespace
{

using Form = mechanism::RelativeMeasure::Form;
using fem::dot;

/// A name of its own among all that signals refer to.
void check_new_name(const SceneTable &table, const Names &names, const Scene &scene)
{
  check_thing_name(table);
  const std::string name = table.name();
  if (names.find_body(name))
    throw table.error("a body has the name '" + name + "' too; their signals would have the same names");
  if (scene.element_places.count(name))
    throw table.error("the name '" + name + "' is used at " + scene.element_places.at(name) +
                      " too; their signals would have the same names");
}

void check_two_places(const SceneTable &table, const PlaceRequest &from, const PlaceRequest &to)
{
  if (from.marker == to.marker)
    throw table.error("to",
                      "lies on '" + to.marker + "' like `from`; it needs two bodies that can move against each other");
}

bool turns_freely(const Names &names, const std::string &marker)
{
  const BodyRequest *body = names.find_body(marker);
  return body && body->kind == coupling::BodyKind::rigid;
}

/// What the direction of `along` turns with.
mechanism::RelativeMeasure::Carrier read_carrier(const SceneTable &table, const Names &names,
                                                 const MeasureRequest &along)
{
  using Carrier = mechanism::RelativeMeasure::Carrier;
  if (!table.has("carried_by"))
    return Carrier::space;
  const std::string carrier = names.marker(table, "carried_by");
  if (carrier == along.first.marker)
    return Carrier::first;
  if (carrier == along.second.marker)
    return Carrier::second;
  throw table.error("carried_by", "is '" + carrier + "', but the direction can turn with `from` or `to` only, '" +
                                      along.second.marker + "' or '" + along.first.marker + "'");
}

/// Joints that count turns: a body that turns freely in space has no angle without end.
void refuse_in_space(const SceneTable &table, const std::string &key, const std::string &marker, const Names &names)
{
  if (turns_freely(names, marker))
    throw table.error(key, "'" + marker +
                               "' is a rigid body, whose turns are not counted; put a rotor between, which a "
                               "joint of type \"rigid\" holds to it");
}

/// The teeth of two wheels: the way along their line of action.
MeasureRequest read_gear(const SceneTable &table, const Names &names)
{
  MeasureRequest measure;
  measure.form   = Form::gear;
  measure.unit   = "m";
  measure.first  = names.place(table, "from", "at_from");
  measure.second = names.place(table, "to", "at_to");
  check_two_places(table, measure.first, measure.second);
  MeshRequest mesh;
  mesh.axis = table.direction("axis");
  for (const bool first : {true, false})
  {
    const std::string  key    = first ? "from" : "to";
    const std::string &marker = first ? measure.first.marker : measure.second.marker;
    refuse_in_space(table, key, marker, names);
    const BodyRequest *body = names.find_body(marker);
    if (body && (body->kind == coupling::BodyKind::rotor || body->kind == coupling::BodyKind::planar) &&
        std::abs(std::abs(dot(body->axis, mesh.axis)) - 1.) > 1e-9)
      throw table.error("axis", "is not that of '" + marker + "'; wheels with teeth in mesh turn about parallel axes");
  }
  mesh.ratio = table.value("ratio");
  if (mesh.ratio == 0. || mesh.ratio == 1.)
    throw table.error("ratio", "must be neither 0 nor 1: negative of two outer wheels, positive with a ring");
  mesh.pressure_angle = table.value("pressure_angle");
  if (!(std::abs(mesh.pressure_angle) < 0.25 * M_PI))
    throw table.error("pressure_angle", "must lie between -45 and 45 degrees");
  measure.mesh = mesh;
  return measure;
}

/// The table with the keys of its type.
SceneTable typed(const SceneTable &any, const std::vector<TypeOfTable> &types)
{
  return any.declared(keys_of(types, any.declared(types.front().keys).choice("type")));
}

MeasureRequest read_measure(const SceneTable &any, const Names &names)
{
  const SceneTable table = typed(any, measure_types());
  MeasureRequest   measure;
  measure.name           = table.name();
  measure.place          = table.place();
  const std::string type = table.choice("type");
  if (type == "position function" || type == "sum" || type == "gear mesh")
  {
    ScalarRequest x;
    measure       = type == "sum"         ? read_sum(table, names)
                    : type == "gear mesh" ? read_gear(table, names)
                                          : read_position_function(table, names, x);
    measure.name  = table.name();
    measure.place = table.place();
    return measure;
  }
  PlaceRequest from = names.place(table, "from", "at_from"), to = names.place(table, "to", "at_to", "ground");
  if (type == "angle")
    refuse_turning_point(table, names, from, to);
  if (from.marker == to.marker)
    throw table.error("to", "lies on '" + to.marker + "' like `from`; what is measured would never change");
  measure.unit   = type == "inclination" || type == "angle" ? "rad" : "m";
  measure.first  = from;
  measure.second = to;
  if (type == "distance")
    measure.form = Form::distance;
  else if (type == "along") // motion of `from` against `to`
  {
    measure.form = Form::along;
    measure.a    = table.direction("direction");
    std::swap(measure.first, measure.second);
    measure.carrier = read_carrier(table, names, measure);
  }
  else if (type == "angle" && !turns_freely(names, from.marker) && !turns_freely(names, to.marker))
    measure.terms = {{1., difference(from.marker, to.marker, table.direction("about"), true), nullptr}};
  else if (type == "angle") // of `from` against `to`
  {
    const Eigen::Vector3d axis(table.direction("about").data()), zero = axis.unitOrthogonal(), ahead = axis.cross(zero);
    measure.form = Form::angle;
    measure.a    = {zero[0], zero[1], zero[2]};
    measure.b    = {ahead[0], ahead[1], ahead[2]};
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

struct JointName
{
  const char *name;
  JointType   type;
};
constexpr JointName joint_names[] = {
    {"revolute", JointType::revolute},       {"spherical", JointType::spherical}, {"universal", JointType::universal},
    {"cylindrical", JointType::cylindrical}, {"rigid", JointType::rigid},         {"prismatic", JointType::prismatic},
    {"in-plane", JointType::in_plane},       {"distance", JointType::distance},   {"gear", JointType::gear}};

/// Joints of one equation on a scalar of the motion, by their names.
using MeasureJointReader = void (*)(const SceneTable &table, const Names &names, JointRequest &joint);

/// A rotor or planar body, which has an axis to turn about.
const BodyRequest &turning_body(const SceneTable &table, const std::string &key, const std::string &marker,
                                const Names &names)
{
  const BodyRequest *body = names.find_body(marker);
  if (!body || (body->kind != coupling::BodyKind::rotor && body->kind != coupling::BodyKind::planar))
    throw table.error(key, "'" + marker + "' is no rotor or planar body; one that turns about its axis is needed here");
  return *body;
}

/// Way of the second place from the first along a direction that `carrier` turns.
MeasureRequest path(const PlaceRequest &first, const PlaceRequest &second, const Vector3 &direction,
                    mechanism::RelativeMeasure::Carrier carrier)
{
  MeasureRequest along;
  along.first   = first;
  along.second  = second;
  along.a       = direction;
  along.carrier = carrier;
  return along;
}

/// along - factor * angle = 0
void join_path_and_angle(JointRequest &joint, const MeasureRequest &along, double factor, const MotionMeasure &angle)
{
  joint.measure.terms = {{1., {}, std::make_shared<MeasureRequest>(along)}, {-factor, angle, nullptr}};
  joint.measure.unit  = "m";
}

using Carrier = mechanism::RelativeMeasure::Carrier;

void read_cam(const SceneTable &table, const Names &names, JointRequest &joint)
{
  ScalarRequest x;
  joint.measure = read_position_function(table, names, x);
  refuse_jumps(table, *joint.measure.function, x.kind());
  joint.value         = 0.;
  joint.reaction_unit = x.unit == "rad" ? "N m" : "N";
}

void read_screw(const SceneTable &table, const Names &names, JointRequest &joint)
{
  joint.from = names.place(table, "from", "at_from");
  joint.to   = names.place(table, "to", "at_to");
  check_two_places(table, joint.from, joint.to);
  refuse_in_space(table, "from", joint.from.marker, names);
  refuse_in_space(table, "to", joint.to.marker, names);
  const Vector3 axis = table.direction("axis");
  for (const PlaceRequest *place : {&joint.from, &joint.to})
    check_no_skew_axis(table, names, place->marker, axis);
  const double pitch = table.value("pitch");
  if (pitch == 0.)
    throw table.error("pitch", "is zero; give the way of one turn, negative for a left-handed thread");
  join_path_and_angle(joint, path(joint.from, joint.to, axis, Carrier::first), pitch / (2. * M_PI),
                      difference(joint.to.marker, joint.from.marker, axis, true));
}

/// Whether a body or what carries it may move along a direction.
bool moves_along(const Names &names, const std::string &marker, const Vector3 &direction)
{
  using coupling::BodyKind;
  const BodyRequest *body = names.find_body(marker);
  if (!body)
    return marker != "ground";
  if (body->kind == BodyKind::planar)
    return std::abs(std::abs(dot(body->axis, direction)) - 1.) > 1e-9;
  if (body->kind == BodyKind::slider && std::abs(dot(body->axis, direction)) > 1e-9)
    return true;
  const bool carried = body->kind == BodyKind::slider || body->kind == BodyKind::rotor;
  return !carried || body->carrier != "ground";
}

/// The wheel `from` rolls on `to`, or moves the rack `to`.
void read_rolling(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const bool rack = table.text("type") == "rack";
  joint.from      = names.place(table, "from", "at_from");
  joint.to        = rack ? names.place(table, "to", "at_to") : names.place(table, "to", "at_to", "ground");
  check_two_places(table, joint.from, joint.to);
  refuse_in_space(table, "to", joint.to.marker, names);
  const BodyRequest &wheel     = turning_body(table, "from", joint.from.marker, names);
  const double       radius    = table.value("radius");
  const Vector3      direction = table.direction("direction");
  if (std::abs(dot(direction, wheel.axis)) > 1e-9)
    throw table.error("direction", "must be at right angles to the axis of '" + joint.from.marker + "'");
  if (!moves_along(names, joint.from.marker, direction) && !moves_along(names, joint.to.marker, direction))
    throw table.error("direction", "neither '" + joint.from.marker + "' nor '" + joint.to.marker +
                                       "' can move along it, so that the wheel could not turn; " +
                                       (rack ? "give the direction in which the rack moves"
                                             : "make the wheel a planar body, or let what carries it move"));
  const auto angle = difference(joint.from.marker, joint.to.marker, wheel.axis, true);
  if (rack)
    join_path_and_angle(joint, path(joint.from, joint.to, direction, Carrier::second), radius, angle);
  else
    join_path_and_angle(joint, path(joint.to, joint.from, direction, Carrier::first), radius, angle);
}

void read_gear_mesh(const SceneTable &table, const Names &names, JointRequest &joint)
{
  joint.measure = read_gear(table, names);
}

void read_prescribed(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const auto on       = read_scalar(table, "on", names);
  joint.measure.terms = {on.term};
  joint.measure.unit  = on.unit;
  joint.law           = read_motion(table.table("motion"), on.unit == "rad");
  if (table.has("initial"))
    joint.value = table.value("initial", on.unit == "rad");
}

/// A gear whose wheels are carried by a third body: their motions count against it (Willis).
void read_carried_gear(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const std::string carrier = names.marker(table, "carrier");
  refuse_in_space(table, "carrier", carrier, names);
  for (const bool first : {true, false})
  {
    const std::string  key    = first ? "from" : "to";
    const std::string &marker = first ? joint.from.marker : joint.to.marker;
    const BodyRequest *body   = names.find_body(marker);
    if (!body || body->kind == coupling::BodyKind::point || body->kind == coupling::BodyKind::rigid)
      throw table.error(key, "a gear couples rotors, sliders and planar bodies by their one angle or displacement");
    if (marker == carrier)
      throw table.error("carrier", "is '" + carrier + "' like `" + key + "`; it must be what carries the wheels");
    const bool slides = body->kind == coupling::BodyKind::slider;
    joint.measure.terms.push_back(
        {first ? -joint.ratio : 1., difference(marker, carrier, body->axis, !slides), nullptr});
    joint.measure.unit = slides ? "m" : "rad";
  }
  joint.type = JointType::measure;
}

struct MeasureJointName
{
  const char        *name;
  MeasureJointReader read;
};
constexpr MeasureJointName measure_joints[] = {{"position function", read_cam}, {"screw", read_screw},
                                               {"rolling", read_rolling},       {"rack", read_rolling},
                                               {"gear mesh", read_gear_mesh},   {"prescribed motion", read_prescribed}};

/// @param any  whose keys of other types are refused in words
JointRequest read_joint(const SceneTable &any, const Names &names)
{
  const SceneTable table = typed(any, joint_types());
  JointRequest     joint;
  joint.name             = table.name();
  joint.place            = table.place();
  const std::string type = table.choice("type");
  for (const JointName &known : joint_names)
    if (known.name == type)
      joint.type = known.type;
  for (const MeasureJointName &known : measure_joints)
    if (known.name == type)
    {
      joint.type = JointType::measure;
      read_compliance(any, joint.type); // refuses it
      known.read(table, names, joint);
      return joint;
    }
  const bool together = joint.type == JointType::revolute || joint.type == JointType::spherical ||
                        joint.type == JointType::universal || joint.type == JointType::cylindrical ||
                        joint.type == JointType::rigid;
  const bool one_point = any.has("at");
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
  read_axes(table, names, joint);
  joint.compliance = read_compliance(any, joint.type);
  joint.friction   = read_joint_friction(any, joint.type);
  if (joint.type == JointType::gear)
  {
    joint.ratio = table.value("ratio");
    if (table.has("carrier"))
      read_carried_gear(table, names, joint);
  }
  if (joint.type == JointType::distance)
  {
    if (table.has("length"))
      joint.length = table.value("length");
    if (const auto motion = table.optional_table("motion"))
      joint.law = read_motion(*motion, false);
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
      throw table.error("a body has the name '" + table.name() + "' too; 'from' and 'to' would be ambiguous");
    const SceneTable   own = table.declared(place_keys());
    const PlaceRequest point{names.marker(own, "on"), own.vector("at")};
    names.add_place(table.name(), point);
    result.places.push_back({table.name(), point, table.place()});
  }
  const std::vector<SceneTable> measures = scene.tables("measure");
  result.measures.resize(measures.size());
  for (const std::size_t i : reading_order(measures))
  {
    const SceneTable &table = measures[i];
    check_new_name(table, names, result);
    result.measures[i]                  = read_measure(table, names);
    result.element_places[table.name()] = table.place();
    names.add_measure(result.measures[i]);
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

} // namespace gestell::apps
