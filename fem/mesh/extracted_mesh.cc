#include "fem/mesh/extracted_mesh.h"

#include "fem/values/message_text.h"
#include "fem/values/vector3.h"

#include <algorithm>

namespace gestell::fem
{

namespace
{

constexpr double same_place = 1e-8; // of the model: nodes that close lie upon each other

double extent(const Mesh &mesh)
{
  Vector3 low = mesh.points.front(), high = low;
  for (const Point3 &point : mesh.points)
    for (int d = 0; d < 3; ++d)
    {
      low[d]  = std::min(low[d], point[d]);
      high[d] = std::max(high[d], point[d]);
    }
  return norm(high - low);
}

} // namespace

std::string touching_nodes(const Mesh &mesh)
{
  const double size  = extent(mesh);
  const auto   pairs = coincident(mesh.points, same_place * size);
  if (pairs.empty())
    return "";
  return ". " + std::to_string(pairs.size()) + " nodes coincide with others, one at " +
         text(mesh.points[pairs.front().first]) +
         " m: solids touch there without being joined. Merge them if they are one body (mesh.gap = \"" +
         text(1e3 * 10. * same_place * size) + " mm\"), or set mesh.bodies if they are not";
}

void note_nodes(Mesh &mesh, const MeshNodes &nodes)
{
  if (nodes.n_merged() > 0)
    mesh.statements.push_back(std::to_string(nodes.n_merged()) +
                              " nodes are merged with another node, as mesh.gap requires");
  if (const auto n_unused = nodes.n_unused(); n_unused > 0)
    mesh.notes.push_back(std::to_string(n_unused) + " nodes of the file are not part of a cell and are ignored");
  if (const auto pairs = coincident(mesh.points, same_place * extent(mesh)); !pairs.empty())
    mesh.notes.push_back(std::to_string(pairs.size()) + " nodes coincide with others, one at " +
                         text(mesh.points[pairs.front().first]) +
                         " m: the cells there are not joined (a slit); mesh.gap merges them");
}

} // namespace gestell::fem
