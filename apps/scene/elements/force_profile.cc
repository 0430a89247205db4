#include "mechanism/elements/profile_force.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// +F acts on `from` along the direction, on `to` against it.
void read_force_profile(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto   motion = read_load_motion(table, names);
  const Kind  &kind   = motion.rotation ? kind::torque : kind::force;
  const double from   = table.number("initial", kind, 0.);
  if (!table.has("profile"))
    throw table.error("needs 'profile', ramps such as [{ at = \"1 s\", to = \"" + kind.example + "\" }]");
  const ProfileKeys keys    = level_profile(kind, kind.example);
  const auto        profile = read_free_course(table, "profile", keys, from);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::ProfileForce>(profile); }),
                 motion);
  scene.elements.back().levels = std::make_shared<ProfileKeys>(keys);
}

} // namespace gestell::apps
