#include "apps/scene/bodies/body_types.h"
#include "apps/scene/read/read_part.h"

namespace gestell::apps
{

BodyType slider_type()
{
  return {
      "slider",
      "Body that moves along an axis: one displacement.",
      joined({{key::direction("axis", "direction of motion").into(&BodyRequest::axis),
               key::named("guide", "carrier: the body or interface with which it moves sideways").by_default("ground"),
               mass_key(),
               key::vector("position", kind::length, "position in pictures, at zero displacement")
                   .by_default("[0, 0, 0]")
                   .into(&BodyRequest::position),
               drawn_size()},
              part_keys()}),
      coupling::BodyKind::slider,
      [](coupling::MachineModel &machine, const BodyRequest &body)
      { machine.add_slider(body.name, body.axis, body.mass, body.carrier); },
      nullptr,
      "guide"};
}

} // namespace gestell::apps
