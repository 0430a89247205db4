#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/regularised_friction.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{
namespace
{

using mechanism::CoulombFriction;
using mechanism::RegularisedFriction;

/// Stribeck curve and viscous part, which every friction may have.
template <class Friction>
std::vector<Key> curve_keys()
{
  return {
      key::number("stribeck_speed", kind::speed, "Stribeck speed v_s of the transition from static to kinetic friction")
          .on_angle(kind::angular_speed)
          .above_zero()
          .by_default(&Friction::stribeck_speed),
      key::number("stribeck_exponent", kind::number, "exponent n of the transition exp(-(v/v_s)^n), 1 or 2")
          .above_zero()
          .by_default(&Friction::stribeck_exponent),
      key::number("viscous", kind::damping, "viscous damping, in addition")
          .on_angle(kind::torsional_damping)
          .from_zero()
          .by_default(&Friction::viscous)};
}

Key force_key(const std::string &name, const std::string &meaning)
{
  return key::number(name, kind::force, meaning).on_angle(kind::torque).from_zero();
}

} // namespace

void read_friction(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = read_relative_motion(table, names);
  if (table.has("static_force") != table.has("stribeck_speed"))
    throw table.error("needs 'static_force' and 'stribeck_speed' together: the static friction force and the speed "
                      "over which it falls");
  add_law<RegularisedFriction>(scene, table, table.filled<RegularisedFriction::Parameters>(motion.rotation), motion);
}

/// Truly sticks.  Its two forces are given, or follow from a normal force by their coefficients.
void read_dry_friction(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = constant_motion(read_relative_motion(table, names), names);
  refuse_measure(table, motion); // while sticking it constrains its measure
  const bool coefficients = table.has("normal_force") || table.has("static") || table.has("kinetic");
  if (coefficients == (table.has("static_force") || table.has("kinetic_force")))
    throw table.error("needs either 'normal_force' with 'static' and 'kinetic', or 'static_force' and 'kinetic_force'");
  if (coefficients && motion.rotation)
    throw table.error(
        "acts on an angle, where a normal force has no lever arm; give 'static_force' and 'kinetic_force' as torques");

  auto friction = table.filled<CoulombFriction::Parameters>(motion.rotation);
  if (coefficients)
  {
    const double normal    = table.value("normal_force");
    friction.static_force  = table.value("static") * normal;
    friction.kinetic_force = table.value("kinetic") * normal;
  }
  else
    table.demand({"static_force", "kinetic_force"}, motion.rotation);
  if (friction.static_force < friction.kinetic_force)
    throw table.error(coefficients ? "static" : "static_force",
                      std::string("is below '") + (coefficients ? "kinetic" : "kinetic_force") +
                          "'; static friction must be at least the kinetic one");
  add_law<CoulombFriction>(scene, table, friction, motion);
}

/// Keys of brakes and clutches.
static std::vector<Key> brake_keys()
{
  return joined(
      {motion_keys(),
       {force_key("capacity", "friction capacity while slipping").into(&CoulombFriction::Parameters::kinetic_force),
        force_key("static_capacity", "friction limit while sticking")
            .same_as("capacity")
            .into(&CoulombFriction::Parameters::static_force),
        profile_key("engagement", level_profile(kind::number, "5"),
                    "share of the capacity: a level or ramps from 0 to 1"),
        key::number("initial_engagement", kind::number, "engagement before the first ramp").from_zero().by_default(0.),
        waits_key()},
       curve_keys<CoulombFriction::Parameters>()});
}

/// Dry friction that is engaged over time, against the ground or another body.
void read_brake(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = constant_motion(read_relative_motion(table, names), names);
  refuse_measure(table, motion);
  auto brake = table.filled<CoulombFriction::Parameters>(motion.rotation);
  if (brake.static_force < brake.kinetic_force)
    throw table.error("static_capacity", "is below 'capacity'; the static capacity must be at least the sliding one");
  if (!table.has("engagement"))
    throw table.error(
        "needs 'engagement', a fraction from 0 to 1: ramps such as [{ at = \"1 s\", to = 1, rate = \"5/s\" }]");
  const double from = table.value("initial_engagement");
  const auto   keys = level_profile(kind::number, "5");
  brake.engagement  = read_course(table, "engagement", keys, from);
  add_law<CoulombFriction>(scene, table, brake, motion);
  scene.elements.back().levels = std::make_shared<ProfileKeys>(keys);
}

void read_clutch(const SceneTable &table, const Names &names, Scene &scene)
{
  if (!table.has("to"))
    throw table.error("needs 'to', the other body; a clutch to the ground is a brake");
  read_brake(table, names, scene);
}

ElementType friction_type()
{
  using Friction = RegularisedFriction::Parameters;
  return {"friction",
          "Regularised friction: below `speed` it creeps instead of sticking.",
          "`force`, `rate`",
          joined({motion_keys(),
                  {force_key("force", "friction force while sliding").into(&Friction::force),
                   key::number("speed", kind::speed, "speed at which 76 % of the friction is developed")
                       .on_angle(kind::angular_speed)
                       .above_zero()
                       .by_default(&Friction::speed),
                   force_key("static_force", "static friction force; with `stribeck_speed`")
                       .same_as("force")
                       .into(&Friction::static_force)},
                  curve_keys<Friction>()}),
          read_friction,
          {R"toml(from  = "slide"
force = "80 N"
)toml"}};
}

ElementType dry_friction_type()
{
  using Friction = CoulombFriction::Parameters;
  return {"dry friction",
          "Coulomb friction with true sticking, along or about a constant direction; for located events.",
          "`force`, `rate`",
          joined({motion_keys(),
                  {force_key("static_force", "friction limit while sticking")
                       .by_default("from `static`")
                       .unless("static")
                       .into(&Friction::static_force),
                   force_key("kinetic_force", "friction force while sliding")
                       .by_default("from `kinetic`")
                       .unless("kinetic")
                       .into(&Friction::kinetic_force),
                   key::number("normal_force", kind::force, "normal force, by which the coefficients are multiplied")
                       .from_zero()
                       .by_default("none"),
                   key::number("static", kind::number, "static friction coefficient").from_zero().by_default(""),
                   key::number("kinetic", kind::number, "kinetic friction coefficient").from_zero().by_default(""),
                   key::number("speed", kind::speed, "speed of the other surface, such as a belt")
                       .on_angle(kind::angular_speed)
                       .by_default(&Friction::belt_speed)},
                  curve_keys<Friction>()}),
          read_dry_friction,
          {R"toml(from              = "slide"          # stick-slip on a Stribeck curve
static_force      = "120 N"
kinetic_force     = "80 N"
stribeck_speed    = "20 mm/s"
stribeck_exponent = 2
viscous           = "300 N s/m"
)toml",
           R"toml(from         = "slide"
normal_force = "200 N"
static       = 0.2
kinetic      = 0.15
)toml"}};
}

ElementType brake_type()
{
  return {"brake",
          "Brake: Coulomb friction with true sticking against the ground or another body, engaged over time.",
          "`force`, `rate`",
          brake_keys(),
          read_brake,
          {R"toml(from            = "crank"             # engaged within 50 ms at 3 s, released at 5 s
capacity        = "800 N m"
static_capacity = "1 kN m"
engagement      = [{ at = "3 s", to = 1, rate = "20/s" }, { at = "5 s", to = 0 }]
)toml"}};
}

ElementType clutch_type()
{
  return {"clutch",
          "Clutch: a brake between two bodies; `to` is required.",
          "`force`, `rate`",
          brake_keys(),
          read_clutch,
          {R"toml(from       = "flywheel"               # flywheel and crank are coupled at 1 s
to         = "crank"
capacity   = "1.2 kN m"
engagement = [{ at = "1 s", to = 1, rate = "10/s" }]
)toml"}};
}

} // namespace gestell::apps
