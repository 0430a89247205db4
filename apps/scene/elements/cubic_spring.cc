#include "mechanism/elements/cubic_spring.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

void read_cubic_spring(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                         motion = read_relative_motion(table, names);
  const bool                         turns  = motion.rotation;
  mechanism::CubicSpring::Parameters spring;
  spring.stiffness = table.number("stiffness", turns ? kind::torsional_stiffness : kind::stiffness, spring.stiffness);
  spring.cubic     = table.number("cubic", turns ? kind::torsional_cubic_stiffness : kind::cubic_stiffness);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::CubicSpring>(spring); }),
                 motion);
}

} // namespace gestell::apps
