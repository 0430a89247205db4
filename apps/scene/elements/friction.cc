#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/regularised_friction.h"

#include "apps/scene/relative_motion.h"

namespace gestell::apps
{

void read_friction(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                                 motion = read_relative_motion(table, names);
  const bool                                 turns  = motion.rotation;
  mechanism::RegularisedFriction::Parameters friction;
  friction.force = table.not_negative("force", turns ? kind::torque : kind::force);
  friction.speed = table.positive("speed", turns ? kind::angular_speed : kind::speed, friction.speed);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::RegularisedFriction>(friction); }),
              motion);
}

/// Truly sticks.  Its two forces are given, or follow from a normal force by their coefficients.
void read_dry_friction(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion       = read_relative_motion(table, names);
  refuse_measure(table, motion); // it holds its measure where it sticks
  const bool turns        = motion.rotation;
  const bool coefficients = table.has("normal_force") || table.has("static") || table.has("kinetic");
  if (coefficients == (table.has("static_force") || table.has("kinetic_force")))
    throw table.error("needs either 'normal_force' with 'static' and 'kinetic', or 'static_force' and 'kinetic_force'");
  if (coefficients && turns)
    throw table.error("acts on an angle, where a normal force has no lever; give 'static_force' and 'kinetic_force' as "
                      "torques");

  mechanism::CoulombFriction::Parameters friction;
  if (coefficients)
  {
    const double normal    = table.not_negative("normal_force", kind::force);
    friction.static_force  = table.not_negative("static", kind::number) * normal;
    friction.kinetic_force = table.not_negative("kinetic", kind::number) * normal;
  }
  else
  {
    friction.static_force  = table.not_negative("static_force", turns ? kind::torque : kind::force);
    friction.kinetic_force = table.not_negative("kinetic_force", turns ? kind::torque : kind::force);
  }
  if (friction.static_force < friction.kinetic_force)
    throw table.error(coefficients ? "static" : "static_force",
                      std::string("is below '") + (coefficients ? "kinetic" : "kinetic_force") +
                          "'; what slides would hold more than what sticks, give at least as much");
  friction.belt_speed = table.number("speed", turns ? kind::angular_speed : kind::speed, friction.belt_speed);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::CoulombFriction>(friction); }),
              motion);
}

} // namespace gestell::apps
