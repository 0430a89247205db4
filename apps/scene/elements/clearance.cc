#include "mechanism/elements/clearance.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/read_contact.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

namespace
{

using mechanism::Clearance;

/// Play to both sides, or contact on one: closed where u > gap, or -u > gap below.
void read_gap(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = read_relative_motion(table, names);
  add_law<Clearance>(scene, table, read_contact(table, motion.rotation), motion);
}

} // namespace

ElementType clearance_type()
{
  return {"clearance",
          "Play in both directions, with contact at its ends.",
          "`force`, `displacement`",
          joined({motion_keys(),
                  contact_keys(),
                  {key::number("gap", kind::length, "half the total play")
                       .on_angle(kind::angle)
                       .from_zero()
                       .into(&Clearance::Parameters::gap)}}),
          read_gap,
          {R"toml(from      = "flywheel"               # claws with 0.2 degrees of play in both directions
to        = "crank"
gap       = "0.2 deg"
stiffness = "1e6 N m/rad"
)toml",
           R"toml(from         = "spindle"               # axial play of 50 um in both directions
direction    = [1, 0, 0]
gap          = "50 um"
stiffness    = "200 kN/mm"
restitution  = 0.4
impact_speed = "0.1 m/s"
)toml"}};
}

ElementType stop_type()
{
  return {"stop",
          "Contact on one side: closed if u > gap, with `side = \"below\"` if -u > gap.",
          "`force`, `displacement`",
          joined({motion_keys(),
                  contact_keys(),
                  {key::number("gap", kind::length, "u at which the stop closes; may be negative")
                       .on_angle(kind::angle)
                       .by_default(&Clearance::Parameters::gap),
                   key::choice("side", {"above", "below"}, true, "side of the stop")
                       .into(&Clearance::Parameters::stops, {Clearance::Stops::above, Clearance::Stops::below})}}),
          read_gap,
          {R"toml(from      = "slide"
stiffness = "20 kN/mm"
gap       = "10 mm"
)toml"}};
}

} // namespace gestell::apps
