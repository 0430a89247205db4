#include "apps/scene/bodies/body_types.h"
#include "apps/scene/read/read_part.h"
#include "apps/scene/read/read_tensor.h"

namespace gestell::apps
{

BodyType rigid_body_type()
{
  const Key tensor = key::vector("inertia", kind::inertia,
                                 "inertia about the centre of mass: moments `[Jx, Jy, Jz]` about the global axes in "
                                 "the reference configuration, or the tensor `[[Jxx, Jxy, Jxz], ...]`. Each principal "
                                 "moment must be less than the sum of the other two")
                         .also({Key::Form::matrix})
                         .by_default("required; with `cad` that of the shape");
  return {"rigid",
          "Rigid body with six DOFs, free in space.",
          joined({{mass_key(), tensor, principal_axes_key(), centre_key(), drawn_size(), drawn_radius("a sphere")},
                  part_keys()}),
          coupling::BodyKind::rigid,
          [](coupling::MachineModel &machine, const BodyRequest &body)
          { machine.add_rigid(body.name, body.mass, body.tensor, body.position); },
          [](const SceneTable &table, BodyRequest &body)
          {
            if (!table.has("cad"))
              body.tensor = read_tensor(table);
          }};
}

} // namespace gestell::apps
