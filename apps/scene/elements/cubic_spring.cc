#include "mechanism/elements/cubic_spring.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

void read_cubic_spring(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto                         motion = read_relative_motion(table, names);
  const bool                         turns  = motion.rotation;
  mechanism::CubicSpring::Parameters spring;
  spring.stiffness = table.value("stiffness", turns);
  spring.cubic     = table.value("cubic", turns);
  add_law<mechanism::CubicSpring>(scene, table, spring, motion);
}

ElementType cubic_spring_type()
{
  const mechanism::CubicSpring::Parameters own;
  return {"cubic spring",
          "F = c u + c3 u^3 acts on `to` along the direction and on `from` against it.",
          "`force`, `displacement`",
          joined({motion_keys(),
                  {key::number("cubic", kind::cubic_stiffness, "c3").on_angle(kind::torsional_cubic_stiffness),
                   key::number("stiffness", kind::stiffness, "c")
                       .on_angle(kind::torsional_stiffness)
                       .by_default(own.stiffness)}}),
          read_cubic_spring,
          {R"toml(from      = "slide"
stiffness = "20 N/mm"
cubic     = "5 N/mm^3"
)toml"}};
}

} // namespace gestell::apps
