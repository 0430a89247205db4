#include "fem/geometry/inp/inp_middle_nodes.h"

#include "fem/geometry/inp/inp_elements.h"

#include <algorithm>
#include <set>

namespace gestell::fem
{

/// Square of the distance of a node from the middle between two others.
double InpMiddleNodes::nearby(std::size_t node, std::size_t a, std::size_t b) const
{
  const Vector3 r = position_(node) - 0.5 * (position_(a) + position_(b));
  return dot(r, r);
}

/// The edge on which each middle node lies, in the order of the file.
std::vector<std::size_t> InpMiddleNodes::edges_of(int gmsh_type, const std::vector<std::size_t> &nodes) const
{
  const auto              &edges     = inp_edges(gmsh_type);
  const std::size_t        n_corners = nodes.size() - edges.size();
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const auto distance = [&](std::size_t edge)
    { return nearby(nodes[n_corners + k], nodes[edges[edge][0]], nodes[edges[edge][1]]); };
    std::size_t nearest = k;
    for (std::size_t edge = 0; edge < edges.size(); ++edge)
      if (distance(edge) < 0.99 * distance(nearest)) // equal up to the digits of the file
        nearest = edge;
    result.push_back(nearest);
  }
  return result;
}

bool InpMiddleNodes::order(int gmsh_type, std::vector<std::size_t> &nodes)
{
  const std::size_t n_edges = inp_edges(gmsh_type).size(), n_corners = nodes.size() - n_edges;
  if (n_edges == 0)
    return true;
  const std::vector<std::size_t> edges       = edges_of(gmsh_type, nodes);
  const auto                     common      = order_of_.try_emplace(gmsh_type, edges).first;
  const std::size_t              n_different = std::set<std::size_t>(edges.begin(), edges.end()).size();
  if (n_different < n_edges || edges != common->second)
    return false;
  const std::vector<std::size_t> before = nodes;
  for (std::size_t k = 0; k < n_edges; ++k)
    nodes[n_corners + edges[k]] = before[n_corners + k];
  return true;
}

std::vector<std::string> InpMiddleNodes::notes() const
{
  std::vector<std::string> result;
  for (const auto &[kind, edges] : order_of_)
    if (!std::is_sorted(edges.begin(), edges.end()))
      result.push_back("the middle nodes of its " +
                       std::string(kind == 11   ? "tetrahedra"
                                   : kind == 17 ? "hexahedra"
                                                : "prisms") +
                       " are not in the order of Abaqus; they are assigned to the edges they are on");
  return result;
}

} // namespace gestell::fem
