#include "mechanism/elements/profile_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// +F acts on `from` along the direction, on `to` against it.
void read_force_profile(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto   motion = read_load_motion(table, names);
  const Kind  &kind   = motion.rotation ? kind::torque : kind::force;
  const double from   = table.value("initial", motion.rotation);
  if (!table.has("profile"))
    throw table.error("needs 'profile', ramps such as [{ at = \"1 s\", to = \"" + kind.example + "\" }]");
  if (const auto input = read_input(table, "profile", from))
    return add_law<mechanism::ProfileForce>(scene, table, input, motion);
  const ProfileKeys keys    = level_profile(kind, kind.example);
  const auto        profile = read_free_course(table, "profile", keys, from);
  add_law<mechanism::ProfileForce>(scene, table, profile, motion);
  scene.elements.back().levels = std::make_shared<ProfileKeys>(keys);
}

ElementType force_profile_type()
{
  return {
      "force profile",
      "Force over time, acting on `from` along the direction and on `to` in the opposite direction.",
      "`force`, `power`",
      joined({load_motion_keys(),
              {or_input(course_key("profile", level_profile(kind::force, kind::force.example),
                                   "force: a level, ramps or a function of time"))
                   .on_angle(kind::torque),
               key::number("initial", kind::force, "force before the first ramp").on_angle(kind::torque).by_default(0.),
               waits_key()}}),
      read_force_profile,
      {R"toml(from    = "crank"                   # rises over 0.5 s + 0.1 s
profile = [{ at = "0 s", to = "1 kN m", rate = "2 kN m/s", rate_of_rate = "20 kN m/s^2" }]
)toml",
       R"toml(from       = "lance"
direction  = [0, 0, 1]
carried_by = "lance"
profile    = { function = "3 N*t/s", period = "2 s", rise = "6 N" }
)toml",
       R"toml(from    = "slide"
profile = { table = [["0 s", 0], ["1 s", "3 N"], ["2 s", "12 N"]] }
)toml",
       R"toml(from    = "slide"
initial = "2 N"
profile = { input = "push" }            # that an FMU or another program sets
)toml"}};
}

} // namespace gestell::apps
