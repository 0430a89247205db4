#include "apps/scene/bodies/body_types.h"
#include "apps/scene/read/read_part.h"
#include "fem/values/number_text.h"

namespace gestell::apps
{
namespace
{

std::vector<Key> unbalance_keys()
{
  return {key::number("unbalance", kind::unbalance, "mass times eccentricity of the centre of mass")
              .from_zero()
              .by_default("none")
              .into(&UnbalanceRequest::amount),
          key::number("unbalance_phase", kind::angle,
                      "direction of the centre of mass at angle zero, measured in the positive sense from the first "
                      "global axis perpendicular to `axis`")
              .by_default(&UnbalanceRequest::phase),
          key::vector("unbalance_position", kind::length, "point of the axis at which the unbalance acts")
              .by_default("`position`, else the position of its carrier")};
}

/// @throws the error of the table for keys without an unbalance, and for an eccentric mass with too much inertia
std::optional<UnbalanceRequest> read_unbalance(const SceneTable &table)
{
  if (!table.has("unbalance"))
  {
    for (const char *key : {"unbalance_phase", "unbalance_position"})
      if (table.has(key))
        throw table.error(std::string("has '") + key +
                          "' but no 'unbalance'; add one, such as unbalance = \"2.4 g m\"");
    return std::nullopt;
  }
  auto unbalance = table.filled<UnbalanceRequest>();
  for (const char *key : {"position", "unbalance_position"})
    if (table.has(key))
      unbalance.position = table.vector(key);
  return unbalance;
}

/// J about the axis includes the mass at its eccentricity: J >= m e^2 = U^2/m.
void check_unbalance(const SceneTable &table, const BodyRequest &body)
{
  if (const double U = body.unbalance ? body.unbalance->amount : 0.; U * U > body.mass * body.inertia && body.mass > 0.)
    throw table.error("the unbalance of " + short_text(U) + " kg m places the centre of mass of " +
                      short_text(body.mass) + " kg " + short_text(U / body.mass) +
                      " m from the axis, so the inertia must be at least " + short_text(U * U / body.mass) +
                      " kg m^2, got " + short_text(body.inertia) + " kg m^2");
}

void read_rotor(const SceneTable &table, BodyRequest &body)
{
  body.unbalance = read_unbalance(table);
  if (!table.has("cad"))
    check_unbalance(table, body);
}

} // namespace

BodyType rotor_type()
{
  return {
      "rotor",
      "Body that rotates about an axis: one angle.",
      joined({{key::direction("axis", "axis of rotation").into(&BodyRequest::axis),
               key::named("on", "carrier: `\"frame.NAME\"`, a body or `\"ground\"`").by_default("ground"),
               inertia_key("moment of inertia about the axis"),
               key::number(
                   "mass", kind::mass,
                   "mass, which acts on the carrier; with `cad` it is distributed uniformly and replaces `material`")
                   .from_zero()
                   .by_default(&BodyRequest::mass),
               key::vector(
                   "position", kind::length,
                   "position in pictures, at zero displacement; for a rotor on the ground also a point of the axis")
                   .by_default("[0, 0, 0]; with `cad` the centre of mass")
                   .into(&BodyRequest::position),
               drawn_radius("a disc")},
              unbalance_keys(),
              part_keys()}),
      coupling::BodyKind::rotor,
      [](coupling::MachineModel &machine, const BodyRequest &body)
      { machine.add_rotor(body.name, body.axis, body.inertia, body.mass, body.carrier); },
      read_rotor,
      "on"};
}

} // namespace gestell::apps
