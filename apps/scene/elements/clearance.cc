#include "mechanism/elements/clearance.h"

#include "apps/scene/relative_motion.h"

namespace gestell::apps
{
namespace
{

using mechanism::Clearance;

// Hunt and Crossley's factor is a reciprocal speed: s/m, or s/rad between rotors.
const Kind dissipation{"dissipation factor", "0.3 s/m", {-1, 0, 1}};
const Kind torsional_dissipation{"dissipation factor", "0.3 s/rad", {0, 0, 1}};

/// N/m^n, or N m/rad^n between rotors.
Kind stiffness_of(double exponent, bool turns)
{
  if (turns || exponent == 1.)
    return turns ? kind::torsional_stiffness : kind::stiffness;
  const std::string power = exponent == 1.5 ? "1.5" : exponent == 2. ? "2" : "n";
  return {"contact stiffness in N/m^" + power, "5e9", {1. - exponent, 1., -2.}};
}

/// Stiffness, exponent and dissipation, which every contact has.
Clearance::Parameters read_contact(const SceneTable &table, bool turns)
{
  Clearance::Parameters contact;
  contact.exponent    = table.positive("exponent", kind::number, contact.exponent);
  contact.stiffness   = table.positive("stiffness", stiffness_of(contact.exponent, turns));
  contact.dissipation = table.not_negative("dissipation", turns ? torsional_dissipation : dissipation, 0.);
  return contact;
}

void add_contact(Scene &scene, const SceneTable &table, const RelativeMotion &motion,
                 const Clearance::Parameters &contact)
{
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<Clearance>(contact); }), motion);
}

} // namespace

void read_clearance(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion  = read_relative_motion(table, names);
  auto       contact = read_contact(table, motion.rotation);
  contact.gap        = table.not_negative("gap", motion.rotation ? kind::angle : kind::length);
  add_contact(scene, table, motion, contact);
}

/// One-sided: closed where u > gap, or -u > gap below.
void read_stop(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion  = read_relative_motion(table, names);
  const bool turns   = motion.rotation;
  auto       contact = read_contact(table, turns);
  contact.gap        = table.number("gap", turns ? kind::angle : kind::length, 0.);
  contact.stops =
      table.choice("side", {"above", "below"}, "above") == "above" ? Clearance::Stops::above : Clearance::Stops::below;
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
  add_contact(scene, table, motion, contact);
}

} // namespace gestell::apps
