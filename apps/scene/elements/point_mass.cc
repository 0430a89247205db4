#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

void read_point_mass(const SceneTable &table, const Names &names, Scene &scene)
{
  auto point   = table.filled<PointMassRequest>();
  point.name   = table.name();
  point.marker = names.marker(table, "on");
  if (point.marker == "ground")
    throw table.error("on", "a mass on the ground never moves; name a body or an interface of the frame");
  for (const double J : point.inertia)
    if (J < 0.)
      throw table.error("inertia", "needs moments of inertia of zero or more");
  scene.point_masses.push_back(point);
}

ElementType point_mass_type()
{
  return {"point mass",
          "Mass with inertia, attached to a body or an interface of the frame.",
          "",
          {key::named("on", "body or frame.INTERFACE that carries the mass"),
           key::number("mass", kind::mass, "mass of the point").above_zero().into(&PointMassRequest::mass),
           key::vector("inertia", kind::inertia, "moments of inertia about the global axes")
               .by_default("[0, 0, 0]")
               .into(&PointMassRequest::inertia),
           key::vector("offset", kind::length, "offset from the reference point of the carrier")
               .by_default("[0, 0, 0]")
               .into(&PointMassRequest::offset)},
          read_point_mass,
          {R"toml(on   = "slide"
mass = "3 kg"
)toml"}};
}

} // namespace gestell::apps
