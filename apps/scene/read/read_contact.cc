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

Clearance::Parameters read_contact(const SceneTable &table, bool turns)
{
  Clearance::Parameters contact;
  contact.exponent    = table.positive("exponent", kind::number, contact.exponent);
  contact.stiffness   = table.positive("stiffness", stiffness_of(contact.exponent, turns));
  contact.dissipation = table.not_negative("dissipation", turns ? torsional_dissipation : dissipation, 0.);
  if (table.has("restitution") != table.has("impact_speed"))
    throw table.error("needs 'restitution' and 'impact_speed' together: how much of its speed a body keeps depends on "
                      "how fast it comes");
  if (table.has("restitution") && table.has("dissipation"))
    throw table.error("restitution", "says the same as 'dissipation'; give one of them");
  if (table.has("restitution"))
  {
    const double e      = table.positive("restitution", kind::number);
    const double speed  = table.positive("impact_speed", turns ? kind::angular_speed : kind::speed);
    contact.dissipation = checked(table, [&] { return Clearance::dissipation_for(e, speed); });
  }
  return contact;
}

mechanism::SlidingFriction read_sliding_friction(const SceneTable &table)
{
  mechanism::SlidingFriction friction;
  if (!table.has("friction"))
    return friction;
  if (!table.is_table("friction"))
  {
    friction.kinetic = table.not_negative("friction", kind::number);
    return friction;
  }
  const SceneTable own       = table.table("friction");
  friction.kinetic           = own.not_negative("coefficient", kind::number);
  friction.speed             = own.positive("speed", kind::speed, friction.speed);
  friction.stribeck_speed    = own.positive("stribeck_speed", kind::speed, 0.);
  friction.stribeck_exponent = own.positive("stribeck_exponent", kind::number, friction.stribeck_exponent);
  if (own.has("static") != own.has("stribeck_speed"))
    throw own.error("needs 'static' and 'stribeck_speed' together: from where the coefficient falls, and over which "
                    "speed");
  if (own.has("static"))
    friction.static_coefficient = own.not_negative("static", kind::number);
  if (own.has("static") && friction.static_coefficient < friction.kinetic)
    throw own.error("static", "is below 'coefficient'; what slides would hold more than what sticks");
  return friction;
}

} // namespace gestell::apps
