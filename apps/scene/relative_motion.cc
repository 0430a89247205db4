#include "apps/scene/relative_motion.h"

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

RelativeMotion read_relative_motion(const SceneTable &table, const Names &names)
{
  if (table.has("on") && !table.has("from"))
  {
    const MeasureRequest &measure = names.measure(table, "on");
    return {{}, measure.unit == "rad", measure.name};
  }
  const std::string from = names.marker(table, "from"), to = names.marker(table, "to", "ground");
  if (from == to)
    throw table.error("to", "is '" + to + "' like `from`; an element acts between two places");

  const bool along = table.has("direction"), about = table.has("about");
  if (along && about)
    throw table.error("has both 'direction' and 'about'; give 'direction' for a displacement or 'about' for an angle");
  if (along || about)
    return {difference(from, to, table.direction(along ? "direction" : "about"), about), about, ""};

  const BodyRequest *a = names.find_body(from), *b = names.find_body(to);
  if (const auto *slider = leading_body(a, b, coupling::BodyKind::slider))
    return {difference(from, to, slider->axis, false), false, ""};
  const auto *rotor = leading_body(a, b, coupling::BodyKind::rotor);
  if (!rotor || (a && b && !parallel(a->axis, b->axis)))
    throw table.error("give 'direction' (a displacement) or 'about' (an angle) between '" + from + "' and '" + to +
                      "': their axes do not tell");
  return {difference(from, to, rotor->axis, true), true, ""};
}

MotionMeasure motor_angle(const SceneTable &table, const Names &names, const Scene &scene)
{
  const BodyRequest &rotor  = names.body(table, "on", coupling::BodyKind::rotor);
  std::string        stator = "ground";
  for (const BodyRequest &body : scene.bodies)
    if (body.name == rotor.name)
      stator = body.carrier;
  stator = names.marker(table, "to", stator);
  if (stator == rotor.name)
    throw table.error("to", "is '" + stator + "' like `on`; a motor turns its rotor against what carries it");
  const BodyRequest *body = names.find_body(stator);
  if (body && body->kind == coupling::BodyKind::rigid)
    throw table.error("to",
                      "'" + stator +
                          "' is a rigid body, whose angle is no coordinate; put a rotor between, which a joint of "
                          "type \"rigid\" holds to it");
  return difference(rotor.name, stator, rotor.axis, true);
}

void add_element(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceElement> element,
                 const std::vector<MotionMeasure> &measures, const std::vector<LagRequest> &lags)
{
  scene.elements.push_back({table.name(), std::move(element), measures, "", lags});
}

void add_element_on(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceElement> element,
                    const RelativeMotion &motion)
{
  if (motion.on.empty())
    add_element(scene, table, std::move(element), std::vector<MotionMeasure>{motion.u});
  else
    scene.elements.push_back({table.name(), std::move(element), {}, motion.on, {}});
  scene.elements.back().kind = motion.kind();
}

void refuse_measure(const SceneTable &table, const RelativeMotion &motion)
{
  if (!motion.on.empty())
    throw table.error("on", "this element needs a motion along a constant direction; give 'from', 'to' and 'direction' "
                            "instead of a measure");
}

} // namespace gestell::apps
