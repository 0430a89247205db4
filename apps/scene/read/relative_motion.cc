#include "apps/scene/read/relative_motion.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

bool parallel(const Vector3 &a, const Vector3 &b)
{
  return std::abs(std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) - 1.) < 1e-9;
}

/// Axis of the first slider, or of the first rotor, among the two; null if there is none.
const BodyRequest *leading_body(const BodyRequest *from, const BodyRequest *to, coupling::BodyKind kind)
{
  if (from && from->kind == kind)
    return from;
  return to && to->kind == kind ? to : nullptr;
}

/// Displacement along a constant direction, of bodies or of points on them, which also move by rotation.
RelativeMotion displacement(const PlaceRequest &from, const PlaceRequest &to, const Vector3 &direction)
{
  if (!from.at && !to.at)
    return {difference(from.marker, to.marker, direction, false), false, ""};
  MeasureRequest along;
  along.first  = to;
  along.second = from;
  along.a      = direction;
  along.unit   = "m";
  return {{}, false, "", std::make_shared<MeasureRequest>(along)};
}

/// The body named by `to`, or else the carrier of the shaft, which receives the reaction of the motor.
std::string stator_of(const SceneTable &table, const Names &names, const BodyRequest &shaft)
{
  const std::string stator = names.marker(table, "to", shaft.carrier.empty() ? "ground" : shaft.carrier);
  if (stator == shaft.name)
    throw table.error("to", "is '" + stator + "', the same as `on`; a motor acts between a shaft and its carrier");
  const BodyRequest *body = names.find_body(stator);
  if (body && body->kind == coupling::BodyKind::point)
    throw table.error("to", "'" + stator + "' is a point, which has no rotation; name another carrier of the motor");
  if (body && body->kind == coupling::BodyKind::rigid)
    throw table.error("to", "'" + stator +
                                "' is a rigid body, whose angle is not a coordinate; add a rotor and connect it to the "
                                "body by a joint of type \"rigid\"");
  return stator;
}

} // namespace

MotionMeasure difference(const std::string &from, const std::string &to, const Vector3 &axis, bool rotation)
{
  MotionMeasure u;
  if (from != "ground")
    u.push_back({from, rotation, axis, 1.});
  if (to != "ground")
    u.push_back({to, rotation, axis, -1.});
  return u;
}

void refuse_turning_point(const SceneTable &table, const Names &names, const PlaceRequest &from, const PlaceRequest &to)
{
  for (const auto &[key, place] : {std::pair{"from", &from}, std::pair{"to", &to}})
  {
    const BodyRequest *body = names.find_body(place->marker);
    if (body && body->kind == coupling::BodyKind::point)
      throw table.error(key, "'" + place->marker +
                                 "' is a point, which has no rotation; make it a body of "
                                 "type \"planar\" or \"rigid\", or use a displacement");
  }
  for (const char *key : {"at_from", "at_to"})
    if (table.has(key))
      throw table.error(key, "has no effect: an angle applies to the whole body; remove it");
}

namespace
{

/// `from` or `to`: a place, or the angle of a body.
PlaceRequest read_end(const SceneTable &table, const Names &names, const std::string &key, const std::string &at,
                      bool &angle)
{
  if (const BodyRequest *body = table.has(key) ? names.body_of_angle(table.text(key)) : nullptr)
  {
    angle = true;
    return {body->name, {}};
  }
  return key == "to" ? names.place(table, key, at, "ground") : names.place(table, key, at);
}

} // namespace

RelativeMotion read_relative_motion(const SceneTable &table, const Names &names)
{
  if (table.has("on") && !table.has("from"))
  {
    const MeasureRequest &measure = names.measure(table, "on");
    return {{}, measure.unit == "rad", measure.name};
  }
  bool               angle = false;
  const PlaceRequest from  = read_end(table, names, "from", "at_from", angle),
                     to    = read_end(table, names, "to", "at_to", angle);
  if (from.marker == to.marker)
    throw table.error("to", "is '" + to.marker + "', the same as `from`; an element acts between two points");

  const bool along = table.has("direction"), about = table.has("about");
  if (along && about)
    throw table.error("has both 'direction' and 'about'; give 'direction' for a displacement or 'about' for an angle");
  if (along && angle)
    throw table.error("direction", "has no effect: `from` or `to` names an angle; remove it, or name the body");
  if (along)
    return displacement(from, to, table.direction("direction"));
  if (about || angle)
    refuse_turning_point(table, names, from, to);
  if (about)
    return {difference(from.marker, to.marker, table.direction("about"), true), true, ""};
  const BodyRequest *a = names.find_body(from.marker), *b = names.find_body(to.marker);
  if (const auto *slider = leading_body(a, b, coupling::BodyKind::slider); slider && !angle)
    return displacement(from, to, slider->axis);
  const auto *turning = leading_body(a, b, coupling::BodyKind::rotor);
  const auto *rotor   = turning ? turning : leading_body(a, b, coupling::BodyKind::planar);
  if (!rotor || from.at || to.at || (a && b && !parallel(a->axis, b->axis)))
    throw table.error("give 'direction' (a displacement) or 'about' (an angle) between '" + from.marker + "' and '" +
                      to.marker + "': their axes do not determine it");
  return {difference(from.marker, to.marker, rotor->axis, true), true, ""};
}

RelativeMotion read_displacement(const SceneTable &table, const Names &names)
{
  RelativeMotion motion = read_relative_motion(table, names);
  if (motion.rotation)
    throw table.error("acts along a displacement, not on an angle; name a slider in 'from' or give 'direction'");
  return motion;
}

std::vector<Key> motion_keys()
{
  return {
      key::named("from", "body, its angle (`crank.angle`), frame.INTERFACE or marker; the element acts on u = "
                         "motion(from) - motion(to)")
          .by_default("`on`"),
      key::named("to", "the other body, frame.INTERFACE or marker").by_default("ground"),
      key::direction("direction", "direction of the displacement u").by_default("axis of the slider, if there is one"),
      key::direction("about", "axis of the angle u").by_default("axis of the rotor or planar body, if there is one"),
      key::vector("at_from", kind::length, "point of `from` whose displacement is used, in the reference configuration")
          .by_default(""),
      key::vector("at_to", kind::length, "point of `to`, in the reference configuration").by_default(""),
      key::named("on", "measure used as u, instead of `from` and `to`").by_default("`from`"),
  };
}

std::vector<Key> load_motion_keys()
{
  return joined({motion_keys(),
                 {key::named("carried_by", "body of `from` with which the direction rotates; without `to`")
                      .by_default("the direction is constant")}});
}

std::vector<Key> shaft_keys()
{
  return {key::named("on", "rotor, planar body, or measure that is an angle, on which the torque acts"),
          key::named("to", "body or frame.INTERFACE that carries the stator").by_default("carrier of the rotor")};
}

RelativeMotion read_load_motion(const SceneTable &table, const Names &names)
{
  if (!table.has("carried_by"))
    return read_relative_motion(table, names);
  if (table.has("to") || !table.has("direction"))
    throw table.error("carried_by", "needs a direction and no 'to': it is for a load on `from` that rotates with it");
  MeasureRequest along;
  along.first  = {"ground", {}};
  along.second = names.place(table, "from", "at_from");
  along.a      = table.direction("direction");
  along.unit   = "m";
  if (const std::string carrier = names.marker(table, "carried_by"); carrier != along.second.marker)
    throw table.error("carried_by", "is '" + carrier + "', but the load acts on '" + along.second.marker +
                                        "' and can rotate only with it");
  return {{}, false, "", std::make_shared<MeasureRequest>(along), true};
}

RelativeMotion read_shaft(const SceneTable &table, const Names &names)
{
  const std::string name = table.text("on");
  if (const MeasureRequest *measure = names.find_measure(name))
  {
    if (measure->unit != "rad")
      throw table.error("on",
                        "the measure '" + name +
                            "' is a length; a drive acts on a rotor, a planar body or a measure that is an angle");
    if (table.has("to"))
      throw table.error("to",
                        "has no effect: the measure '" + name + "' already defines both sides of the motor; remove it");
    return {{}, true, name};
  }
  const BodyRequest *angle = names.body_of_angle(name), *body = angle ? angle : names.find_body(name);
  if (!body || body->kind != coupling::BodyKind::planar)
    body = &names.body(table, "on", coupling::BodyKind::rotor);
  return {difference(body->name, stator_of(table, names, *body), body->axis, true), true, ""};
}

void add_element(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> element,
                 const std::vector<MotionMeasure> &measures, const std::vector<LagRequest> &lags)
{
  scene.elements.push_back({table.name(), std::move(element), measures, "", lags});
}

void add_element_on(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> element,
                    const RelativeMotion &motion, const std::vector<LagRequest> &lags)
{
  ElementRequest request{table.name(), std::move(element), {}, motion.on, lags};
  request.kind    = motion.kind();
  request.own     = motion.own;
  request.follows = motion.follows;
  if (!motion.is_measure())
    request.measures = {motion.u};
  scene.elements.push_back(std::move(request));
}

RelativeMotion constant_motion(const RelativeMotion &motion, const Names &names)
{
  const MeasureRequest *measure = motion.on.empty() ? nullptr : names.find_measure(motion.on);
  if (!measure || measure->terms.empty() || measure->function)
    return motion;
  RelativeMotion constant{{}, motion.rotation, ""};
  for (const TermRequest &term : measure->terms)
  {
    if (term.placed)
      return motion;
    for (MotionTerm part : term.motion)
    {
      part.weight *= term.weight;
      constant.u.push_back(part);
    }
  }
  return constant;
}

void refuse_measure(const SceneTable &table, const RelativeMotion &motion)
{
  if (motion.is_measure())
    throw table.error(motion.own ? "from" : "on",
                      "sticking needs a constant direction, so this element cannot follow points on rotating bodies; "
                      "name bodies with 'direction' or 'about', or a measure that is an angle of rotors and planar "
                      "bodies, or use \"friction\" or \"lugre friction\", which creep");
}

} // namespace gestell::apps
