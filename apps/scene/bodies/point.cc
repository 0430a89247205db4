#include "apps/scene/bodies/body_types.h"
#include "apps/scene/read/read_part.h"

namespace gestell::apps
{

BodyType point_type()
{
  return {"point", "Point mass, free in space.",
          joined({{mass_key(), centre_key(), drawn_size(), drawn_radius("a sphere")}, part_keys()}),
          coupling::BodyKind::point, [](coupling::MachineModel &machine, const BodyRequest &body) {
            machine.add_point(body.name, body.mass, body.position);
          }};
}

} // namespace gestell::apps
