#include "fem/geometry/cad_model.h"

#include <gmsh.h>

#include <numeric>

namespace gestell::fem
{

double CadModel::diagonal() const
{
  return norm(max - min);
}

double CadModel::volume() const
{
  return std::accumulate(solids.begin(), solids.end(), 0.,
                         [](double sum, const Solid &solid) { return sum + solid.volume; });
}

Solid measured_solid(int tag, double unit)
{
  Solid            solid;
  std::vector<int> above;
  solid.tag = tag;
  gmsh::model::getAdjacencies(3, tag, above, solid.faces);
  auto &[x0, y0, z0] = solid.min;
  auto &[x1, y1, z1] = solid.max;
  gmsh::model::getBoundingBox(3, tag, x0, y0, z0, x1, y1, z1);
  solid.min = unit * solid.min;
  solid.max = unit * solid.max;
  gmsh::model::occ::getMass(3, tag, solid.volume);
  solid.volume *= unit * unit * unit;
  return solid;
}

bool boxes_touch(const Solid &a, const Solid &b, double tolerance)
{
  for (int d = 0; d < 3; ++d)
    if (a.min[d] > b.max[d] + tolerance || b.min[d] > a.max[d] + tolerance)
      return false;
  return true;
}

} // namespace gestell::fem
