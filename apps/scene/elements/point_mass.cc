#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

void read_point_mass(const SceneTable &table, const Names &names, Scene &scene)
{
  PointMassRequest point;
  point.name    = table.name();
  point.marker  = names.marker(table, "on");
  point.mass    = table.positive("mass", kind::mass);
  point.inertia = table.vector("inertia", kind::inertia, {});
  point.offset  = table.vector("offset", kind::length, {});
  if (point.marker == "ground")
    throw table.error("on", "a mass on the ground never moves; name a body or an interface of the frame");
  for (const double J : point.inertia)
    if (J < 0.)
      throw table.error("inertia", "needs moments of inertia of zero or more");
  scene.point_masses.push_back(point);
}

} // namespace gestell::apps
