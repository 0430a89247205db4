#include "fem/mesh/mesh_groups.h"

#include "fem/mesh/joined_cells.h"
#include "fem/values/vector3.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <unordered_set>
#include <utility>

namespace gestell::fem
{

namespace
{

const double bend = std::cos(40. * std::acos(-1.) / 180.); // sharper edges end a surface, as in gmsh's classification

/// Corners of the face a triangle of the skin is (or is half of).
std::vector<int> corners_of(const Mesh &mesh, std::size_t triangle)
{
  if (!mesh.is_half(triangle))
    return {mesh.skin[triangle].begin(), mesh.skin[triangle].end()};
  const auto &quad = mesh.skin_quads[triangle / 2];
  return {quad.begin(), quad.end()};
}

using Membership = std::vector<std::string>; // names of groups

/// @param notes  takes a note on groups with faces that are not outer faces of cells
std::vector<Membership> memberships(const ExtractedMesh &extracted, const MeshGroups &groups,
                                    std::vector<std::string> &notes)
{
  std::vector<Membership> result(extracted.mesh.skin.size());
  for (const auto &[name, nodes] : groups.nodes)
  {
    const std::unordered_set<std::size_t> in(nodes.begin(), nodes.end());
    for (std::size_t t = 0; t < result.size(); ++t)
    {
      const std::vector<int> corners = corners_of(extracted.mesh, t);
      if (std::all_of(corners.begin(), corners.end(), [&](int point) { return in.count(extracted.node[point]) > 0; }))
        result[t].push_back(name);
    }
  }
  for (const auto &[name, faces] : groups.faces)
  {
    std::set<std::vector<std::size_t>> in, outside;
    for (std::vector<std::size_t> face : faces)
    {
      std::sort(face.begin(), face.end());
      in.insert(face);
    }
    for (std::size_t t = 0; t < result.size(); ++t)
    {
      std::vector<std::size_t> face;
      for (const int point : corners_of(extracted.mesh, t))
        face.push_back(extracted.node[point]);
      std::sort(face.begin(), face.end());
      if (in.count(face) == 0)
        continue;
      outside.insert(face);
      if (result[t].empty() || result[t].back() != name)
        result[t].push_back(name);
    }
    if (!outside.empty() && outside.size() < in.size())
      notes.push_back("surface \"" + name + "\": " + std::to_string(in.size() - outside.size()) + " of its " +
                      std::to_string(in.size()) +
                      " faces are not outer faces of cells: cells may be missing there, as in a truncated file; export "
                      "the mesh again if these faces are intended");
  }
  for (Membership &names : result)
  {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
  }
  return result;
}

Vector3 normal_of(const Mesh &mesh, std::size_t triangle)
{
  const auto &[a, b, c] = mesh.skin[triangle];
  return unit(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
}

/// Joins triangles across edges where they belong together.
std::vector<std::size_t> pieces_of(const ExtractedMesh &extracted, const std::vector<Membership> &members)
{
  const Mesh                                             &mesh = extracted.mesh;
  std::map<std::pair<int, int>, std::vector<std::size_t>> around; // edge to triangles
  for (std::size_t t = 0; t < mesh.skin.size(); ++t)
    for (int k = 0; k < 3; ++k)
      around[std::minmax(mesh.skin[t][k], mesh.skin[t][(k + 1) % 3])].push_back(t);

  std::vector<std::size_t> parent(mesh.skin.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto &[edge, triangles] : around)
    for (std::size_t i = 1; i < triangles.size(); ++i)
    {
      const std::size_t a = triangles[0], b = triangles[i];
      const bool        halves = mesh.is_half(a) && mesh.is_half(b) && a / 2 == b / 2;
      const int         of_a = extracted.skin_surface[a], of_b = extracted.skin_surface[b];
      if (halves || (of_a == of_b && members[a] == members[b] &&
                     (of_a != 0 || dot(normal_of(mesh, a), normal_of(mesh, b)) > bend)))
        parent[root(parent, b)] = root(parent, a);
    }
  for (std::size_t &piece : parent)
    piece = root(parent, piece);
  return parent;
}

} // namespace

std::map<int, std::vector<std::string>> divide_skin(ExtractedMesh &extracted, const MeshGroups &groups)
{
  std::vector<int> &surface = extracted.skin_surface;
  const bool        named   = !groups.nodes.empty() || !groups.faces.empty();
  if (!named && std::find(surface.begin(), surface.end(), 0) == surface.end())
    return {};
  const std::vector<Membership>           members = memberships(extracted, groups, extracted.mesh.notes);
  const std::vector<std::size_t>          piece   = pieces_of(extracted, members);
  int                                     last    = *std::max_element(surface.begin(), surface.end());
  std::map<std::size_t, int>              tag_of; // piece to new tag
  std::map<int, std::vector<std::string>> names;
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    if (surface[t] != 0 && !named)
      continue;
    const auto [entry, is_new] = tag_of.try_emplace(piece[t], last + 1);
    if (is_new)
      names[++last] = members[t];
    surface[t] = entry->second;
  }
  return names;
}

} // namespace gestell::fem
