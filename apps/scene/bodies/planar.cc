#include "apps/scene/bodies/body_types.h"
#include "apps/scene/read/read_part.h"

namespace gestell::apps
{

BodyType planar_type()
{
  return {
      "planar", "A body that moves in a plane and turns about its normal by any angle.",
      joined({{key::direction("normal", "across its plane; the angle is positive about it").into(&BodyRequest::axis),
               mass_key(), inertia_key("about its centre of mass, about the normal"), centre_key(), drawn_size(),
               drawn_radius("a plate with a rim")},
              part_keys()}),
      coupling::BodyKind::planar, [](coupling::MachineModel &machine, const BodyRequest &body) {
        machine.add_planar(body.name, body.axis, body.mass, body.inertia, body.position);
      }};
}

} // namespace gestell::apps
