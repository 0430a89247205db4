#include "mechanism/elements/cubic_spring.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

ElementType cubic_spring_type()
{
  using Spring = mechanism::CubicSpring::Parameters;
  return {"cubic spring",
          "Force F = c u + c3 u^3, acting on `to` along the direction and on `from` in the opposite direction.",
          "`force`, `displacement`",
          joined({motion_keys(),
                  {key::number("cubic", kind::cubic_stiffness, "coefficient c3")
                       .on_angle(kind::torsional_cubic_stiffness)
                       .into(&Spring::cubic),
                   key::number("stiffness", kind::stiffness, "coefficient c")
                       .on_angle(kind::torsional_stiffness)
                       .by_default(&Spring::stiffness)}}),
          read_law<mechanism::CubicSpring>,
          {R"toml(from      = "slide"
stiffness = "20 N/mm"
cubic     = "5 N/mm^3"
)toml"}};
}

} // namespace gestell::apps
