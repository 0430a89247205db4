#include "apps/scene/bodies/body_types.h"
#include "apps/scene/read/read_part.h"

namespace gestell::apps
{

BodyType planar_type()
{
  return {
      "planar", "Body that moves in a plane and rotates about its normal through any angle.",
      joined({{key::direction("normal", "normal of the plane; the angle is positive about it").into(&BodyRequest::axis),
               mass_key(), inertia_key("moment of inertia about the centre of mass and the normal"), centre_key(),
               drawn_size(), drawn_radius("a plate with a rim")},
              part_keys()}),
      coupling::BodyKind::planar, [](coupling::MachineModel &machine, const BodyRequest &body) {
        machine.add_planar(body.name, body.axis, body.mass, body.inertia, body.position);
      }};
}

} // namespace gestell::apps
