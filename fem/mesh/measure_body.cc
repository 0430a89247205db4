#include "fem/mesh/measure_body.h"

#include "fem/mesh/gmsh_child.h"
#include "fem/mesh/part_measures.h"

#include <Eigen/Core>

namespace gestell::fem
{

template <typename Archive>
void exchange(Archive &archive, CadBody &body)
{
  auto &[solids, volume, centre, inertia, points, triangles] = body;
  archive(solids, volume, points, triangles);
  archive.run(centre.data(), 3);
  archive.run(inertia.data(), 9);
}

CadBody measure_part(const CadSource &source)
{
  return in_gmsh_child<CadBody>(source, "reading the part", {},
                                [&](const ChildProgress &) { return measures_of_part(source); });
}

} // namespace gestell::fem
