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
  add_element(scene, table, checked(table, [&] { return std::make_shared<mechanism::RegularisedFriction>(friction); }),
              {motion.u});
}

} // namespace gestell::apps
