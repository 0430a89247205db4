#include "apps/scene/read/read_wheels.h"

#include "fem/values/number_text.h"
#include "fem/values/vector3.h"

#include <utility>

namespace gestell::apps
{
namespace
{

using coupling::BodyKind;
using fem::operator-, fem::operator*; // vectors are plain arrays

/// The body of a wheel must turn about the axis, and count its turns; the ground or an interface is a wheel at rest.
void check_turning(const SceneTable &table, const std::string &key, const BodyRequest &body, const Vector3 &axis)
{
  if (body.kind == BodyKind::rigid)
    throw table.error(key, "'" + body.name +
                               "' is a rigid body, whose revolutions are not counted; add a rotor that is connected to "
                               "it by a joint of type \"rigid\"");
  if (body.kind != BodyKind::rotor && body.kind != BodyKind::planar)
    throw table.error(key, "'" + body.name + "' does not rotate; a wheel is a rotor or a planar body");
  if (std::abs(std::abs(fem::dot(body.axis, axis)) - 1.) > 1e-9)
    throw table.error("axis", "is not that of '" + body.name + "'; both wheels must rotate about parallel axes");
}

PlaceRequest read_wheel(const SceneTable &table, const Names &names, const std::string &key, const Vector3 &axis)
{
  PlaceRequest       place = names.place(table, key, "at_" + key);
  const BodyRequest *body  = names.find_body(place.marker);
  if (body)
    check_turning(table, key, *body, axis);
  if (!place.at && body)
    place.at = body->position;
  if (!place.at)
    throw table.error(key, "needs 'at_" + key + "', the centre of the wheel on '" + place.marker +
                               "' in the initial configuration");
  return place;
}

} // namespace

std::vector<Key> wheel_keys(const std::string &wheel)
{
  return {
      key::named("from", "body with one " + wheel + ": a rotor or a planar body; at rest an interface or the ground"),
      key::named("to", "body with the other " + wheel),
      key::vector("at_from", kind::length, "centre of the " + wheel + " on `from`, in the initial configuration")
          .by_default("`position` of the body, for a planar body its centre of mass"),
      key::vector("at_to", kind::length, "centre of the " + wheel + " on `to`, in the initial configuration")
          .by_default("`position` of the body, for a planar body its centre of mass"),
      key::direction("axis", "common axis direction; left is the left-hand side when looking from `from` to `to` with "
                             "the axis pointing to the viewer")};
}

std::string wheel_example()
{
  return R"toml(from        = "flywheel"
to          = "crank"
at_from     = [0, 0, 0]
at_to       = ["0.6 m", 0, 0]
axis        = [0, 1, 0]
)toml";
}

WheelPair read_wheels(const SceneTable &table, const Names &names, const std::string &wheel)
{
  WheelPair wheels;
  wheels.axis = table.direction("axis");
  wheels.from = read_wheel(table, names, "from", wheels.axis);
  wheels.to   = read_wheel(table, names, "to", wheels.axis);
  if (wheels.from.marker == wheels.to.marker)
    throw table.error("to", "is on '" + wheels.to.marker + "', the body of `from`; name two bodies");
  const Vector3 centres = *wheels.to.at - *wheels.from.at;
  const double  beside  = fem::dot(centres, wheels.axis);
  wheels.distance       = fem::norm(centres - beside * wheels.axis);
  // Written with a few digits, centres miss one plane by rounding; a real offset would twist both bodies.
  if (std::abs(beside) > 1e-6 * wheels.distance)
    throw table.error("at_to", "the centres of the " + wheel + "s are in two planes normal to 'axis', " +
                                   short_text(std::abs(beside)) +
                                   " m apart; give 'at_from' and 'at_to' in the same plane");
  return wheels;
}

void add_on_tangents(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> law,
                     const WheelPair &wheels, TangentsRequest tangents)
{
  tangents.axis = wheels.axis;
  ElementRequest element;
  element.name    = table.name();
  element.element = std::move(law);
  element.pair    = PairRequest{wheels.from, wheels.to, {}, {}, std::make_shared<TangentsRequest>(tangents)};
  scene.elements.push_back(std::move(element));
}

} // namespace gestell::apps
