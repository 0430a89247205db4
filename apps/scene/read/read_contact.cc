#include "apps/scene/read/read_contact.h"

#include "apps/scene/language/quantity.h"
#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{
namespace
{

using mechanism::Clearance;

// Hunt and Crossley's factor is a reciprocal speed: s/m, or s/rad between rotors.
const Kind dissipation{"dissipation factor", "0.3 s/m", {-1, 0, 1}};
const Kind torsional_dissipation{"dissipation factor", "0.3 s/rad", {0, 0, 1}, Counts::turns};

/// N/m^n, or N m/rad^n between rotors.
Kind stiffness_of(double exponent, bool turns)
{
  if (turns || exponent == 1.)
    return turns ? kind::torsional_stiffness : kind::stiffness;
  const std::string power = exponent == 1.5 ? "1.5" : exponent == 2. ? "2" : "n";
  return {"contact stiffness in N/m^" + power, "5e9", {1. - exponent, 1., -2.}};
}

} // namespace

std::vector<Key> contact_keys()
{
  return {
      key::number("stiffness", kind::stiffness, "contact stiffness; in N/m^n as a plain number")
          .on_angle(kind::torsional_stiffness)
          .above_zero(),
      key::number("exponent", kind::number, "exponent n of the force c d^n; 1.5 for Hertzian contact")
          .above_zero()
          .by_default(&Clearance::Parameters::exponent),
      key::number("dissipation", dissipation, "dissipation factor of Hunt and Crossley")
          .on_angle(torsional_dissipation)
          .from_zero()
          .by_default(&Clearance::Parameters::dissipation),
      key::number("restitution", kind::number, "coefficient of restitution of a free body, instead of `dissipation`")
          .as_share()
          .by_default(""),
      key::number("impact_speed", kind::speed, "impact speed at which `restitution` applies")
          .on_angle(kind::angular_speed)
          .above_zero()
          .by_default(""),
  };
}

Key sliding_friction_key()
{
  using Friction = mechanism::SlidingFriction;
  return key::composed(
             "friction", Key::Form::coefficient, kind::number,
             {key::number("coefficient", kind::number, "friction coefficient while sliding")
                  .from_zero()
                  .into(&Friction::kinetic),
              key::number("speed", kind::speed, "speed at which 76 % of the friction is developed")
                  .above_zero()
                  .by_default(&Friction::speed),
              key::number("static", kind::number, "static friction coefficient; with `stribeck_speed`")
                  .from_zero()
                  .by_default("")
                  .into(&Friction::static_coefficient),
              key::number("stribeck_speed", kind::speed, "Stribeck speed of the transition to the kinetic coefficient")
                  .above_zero()
                  .by_default(&Friction::stribeck_speed),
              key::number("stribeck_exponent", kind::number, "exponent of the transition, 1 or 2")
                  .above_zero()
                  .by_default(&Friction::stribeck_exponent)},
             "coefficient of sliding friction, or a table")
      .from_zero()
      .by_default("none");
}

Clearance::Parameters read_contact(const SceneTable &table, bool turns)
{
  Clearance::Parameters contact;
  table.fill(contact, turns);
  contact.stiffness = table.positive("stiffness", stiffness_of(contact.exponent, turns));
  if (table.has("restitution") != table.has("impact_speed"))
    throw table.error(
        "needs 'restitution' and 'impact_speed' together, because restitution depends on the impact speed");
  if (table.has("restitution") && table.has("dissipation"))
    throw table.error("restitution", "means the same as 'dissipation'; give only one of them");
  if (table.has("restitution"))
  {
    const double e      = table.positive("restitution", kind::number);
    const double speed  = table.value("impact_speed", turns);
    contact.dissipation = checked(table, [&] { return Clearance::dissipation_for(e, speed); });
  }
  return contact;
}

mechanism::SlidingFriction read_sliding_friction(const SceneTable &any)
{
  static const std::vector<Key> keys  = {sliding_friction_key()};
  const SceneTable              table = any.declared(keys); // joints, which have it too, declare nothing yet
  mechanism::SlidingFriction    friction;
  if (!table.has("friction"))
    return friction;
  if (!table.is_table("friction"))
  {
    friction.kinetic = table.value("friction");
    return friction;
  }
  const SceneTable own = table.table("friction");
  own.fill(friction);
  if (own.has("static") != own.has("stribeck_speed"))
    throw own.error(
        "needs 'static' and 'stribeck_speed' together: the static coefficient and the speed over which it falls");
  if (own.has("static") && friction.static_coefficient < friction.kinetic)
    throw own.error("static", "is below 'coefficient'; static friction must be at least the kinetic one");
  return friction;
}

} // namespace gestell::apps
