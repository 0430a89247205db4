#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/regularised_friction.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{
namespace
{

using mechanism::CoulombFriction;
using mechanism::RegularisedFriction;

const Kind &force_kind(const RelativeMotion &motion)
{
  return motion.rotation ? kind::torque : kind::force;
}

const Kind &speed_kind(const RelativeMotion &motion)
{
  return motion.rotation ? kind::angular_speed : kind::speed;
}

/// Stribeck curve and viscous part, which every friction may have.
template <typename Parameters>
void read_curve(const SceneTable &table, const RelativeMotion &motion, Parameters &friction)
{
  friction.stribeck_speed    = table.positive("stribeck_speed", speed_kind(motion), 0.);
  friction.stribeck_exponent = table.positive("stribeck_exponent", kind::number, friction.stribeck_exponent);
  friction.viscous = table.not_negative("viscous", motion.rotation ? kind::torsional_damping : kind::damping, 0.);
}

void add_friction(const SceneTable &table, const RelativeMotion &motion, const CoulombFriction::Parameters &friction,
                  Scene &scene)
{
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<CoulombFriction>(friction); }), motion);
}

} // namespace

void read_friction(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                      motion = read_relative_motion(table, names);
  RegularisedFriction::Parameters friction;
  friction.force        = table.not_negative("force", force_kind(motion));
  friction.speed        = table.positive("speed", speed_kind(motion), friction.speed);
  friction.static_force = table.not_negative("static_force", force_kind(motion), friction.force);
  read_curve(table, motion, friction);
  if (table.has("static_force") != table.has("stribeck_speed"))
    throw table.error("needs 'static_force' and 'stribeck_speed' together: from where the force falls, and over which "
                      "speed");
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<RegularisedFriction>(friction); }), motion);
}

/// Truly sticks.  Its two forces are given, or follow from a normal force by their coefficients.
void read_dry_friction(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = constant_motion(read_relative_motion(table, names), names);
  refuse_measure(table, motion); // it holds its measure where it sticks
  const bool coefficients = table.has("normal_force") || table.has("static") || table.has("kinetic");
  if (coefficients == (table.has("static_force") || table.has("kinetic_force")))
    throw table.error("needs either 'normal_force' with 'static' and 'kinetic', or 'static_force' and 'kinetic_force'");
  if (coefficients && motion.rotation)
    throw table.error("acts on an angle, where a normal force has no lever; give 'static_force' and 'kinetic_force' as "
                      "torques");

  CoulombFriction::Parameters friction;
  if (coefficients)
  {
    const double normal    = table.not_negative("normal_force", kind::force);
    friction.static_force  = table.not_negative("static", kind::number) * normal;
    friction.kinetic_force = table.not_negative("kinetic", kind::number) * normal;
  }
  else
  {
    friction.static_force  = table.not_negative("static_force", force_kind(motion));
    friction.kinetic_force = table.not_negative("kinetic_force", force_kind(motion));
  }
  if (friction.static_force < friction.kinetic_force)
    throw table.error(coefficients ? "static" : "static_force",
                      std::string("is below '") + (coefficients ? "kinetic" : "kinetic_force") +
                          "'; what slides would hold more than what sticks, give at least as much");
  friction.belt_speed = table.number("speed", speed_kind(motion), friction.belt_speed);
  read_curve(table, motion, friction);
  add_friction(table, motion, friction, scene);
}

/// Dry friction that is engaged over time, against the ground or another body.
void read_brake(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = constant_motion(read_relative_motion(table, names), names);
  refuse_measure(table, motion);
  CoulombFriction::Parameters brake;
  brake.kinetic_force = table.not_negative("capacity", force_kind(motion));
  brake.static_force  = table.not_negative("static_capacity", force_kind(motion), brake.kinetic_force);
  if (brake.static_force < brake.kinetic_force)
    throw table.error("static_capacity", "is below 'capacity'; what slides would hold more than what sticks");
  read_curve(table, motion, brake);
  if (!table.has("engagement"))
    throw table.error("needs 'engagement', a share from 0 to 1: ramps such as [{ at = \"1 s\", to = 1, rate = \"5/s\" "
                      "}]");
  const double from = table.not_negative("initial_engagement", kind::number, 0.);
  const auto   keys = level_profile(kind::number, "5");
  brake.engagement  = read_course(table, "engagement", keys, from);
  add_friction(table, motion, brake, scene);
  scene.elements.back().levels = std::make_shared<ProfileKeys>(keys);
}

void read_clutch(const SceneTable &table, const Names &names, Scene &scene)
{
  if (!table.has("to"))
    throw table.error("needs 'to', the body that is coupled; against the ground it would be a brake");
  read_brake(table, names, scene);
}

} // namespace gestell::apps
