#include "fem/mesh_extraction.h"

#include "fem/hexahedral_extraction.h"
#include "fem/mesh_quality.h"
#include "fem/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

using Triangle = std::array<int, 3>;

/// The four faces of a positively oriented cell, seen from outside.
constexpr std::array<std::array<int, 3>, 4> outward = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

Triangle sorted(Triangle triangle)
{
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

struct CellFace
{
  Triangle key;
  int      cell, face;
  bool     operator<(const CellFace &other) const
  {
    return std::tie(key, cell, face) < std::tie(other.key, other.cell, other.face);
  }
};

/// gmsh's node tags and what became of them.
class Nodes
{
public:
  Nodes()
  {
    std::vector<std::size_t> tags;
    std::vector<double>      coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    for (std::size_t i = 0; i < tags.size(); ++i)
      position_[tags[i]] = {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
  }

  /// Index of the point in `points`, which grows by the nodes that cells use.
  int index(std::size_t tag, std::vector<Point3> &points, double unit)
  {
    const auto [entry, is_new] = index_.try_emplace(tag, static_cast<int>(points.size()));
    if (is_new)
      points.push_back(unit * position_.at(tag));
    return entry->second;
  }

  /// Tag of each point.
  std::vector<std::size_t> tags() const
  {
    std::vector<std::size_t> tags(index_.size());
    for (const auto &[tag, index] : index_)
      tags[index] = tag;
    return tags;
  }

  /// Index of a node that a cell uses, -1 for others.
  int index(std::size_t tag) const
  {
    const auto entry = index_.find(tag);
    return entry == index_.end() ? -1 : entry->second;
  }

private:
  std::map<std::size_t, Point3> position_;
  std::map<std::size_t, int>    index_;
};

/// Calls visit(corner tags) for every element of the entity; only simplices of the dimension are let through.
template <typename Visit>
void for_each_simplex(int dim, int tag, const std::string &head, const Visit &visit)
{
  std::vector<int>                      types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, dim, tag);
  for (std::size_t i = 0; i < types.size(); ++i)
  {
    std::string         name;
    int                 d, order, n, n_corners;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(types[i], name, d, order, n, local, n_corners);
    if (n_corners != dim + 1)
      throw std::invalid_argument(
          head + " holds elements of type \"" + name +
          "\"; only tetrahedra with triangles on the surfaces are read: mesh it without recombination.");
    for (std::size_t j = 0; j < nodes[i].size(); j += static_cast<std::size_t>(n))
      visit(&nodes[i][j]);
  }
}

void read_cells(const CadModel &model, const std::string &head, Nodes &nodes, Mesh &mesh)
{
  for (const Solid &solid : model.solids)
  {
    const std::size_t before = mesh.cells.size();
    for_each_simplex(3, solid.tag, head,
                     [&](const std::size_t *corner)
                     {
                       std::array<int, 4> cell;
                       for (int i = 0; i < 4; ++i)
                         cell[i] = nodes.index(corner[i], mesh.points, model.unit);
                       if (six_volumes(mesh, cell) < 0.)
                         std::swap(cell[2], cell[3]);
                       mesh.cells.push_back(cell);
                     });
    if (mesh.cells.size() == before)
      throw std::invalid_argument(head + ": solid \"" + solid.name + "\" has no volume mesh; " +
                                  (model.meshed
                                       ? "mesh it in 3D before saving, and save all elements."
                                       : "its surface may cross itself: choose another mesh.size or repair it."));
    mesh.cell_solid.resize(mesh.cells.size(), static_cast<int>(mesh.solids.size()));
    mesh.solids.push_back(solid.name);
  }
}

std::vector<CellFace> sorted_faces(const Mesh &mesh)
{
  std::vector<CellFace> faces;
  faces.reserve(4 * mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int f = 0; f < 4; ++f)
    {
      const auto &[i, j, k] = outward[f];
      const auto &cell      = mesh.cells[c];
      faces.push_back({sorted({cell[i], cell[j], cell[k]}), static_cast<int>(c), f});
    }
  std::sort(faces.begin(), faces.end());
  return faces;
}

int root(std::vector<int> &parent, int i)
{
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}

/// Pairs of equal faces join cells, single faces are the skin.
std::vector<CellFace> join(const std::vector<CellFace> &faces, std::vector<int> &parent, const std::string &head)
{
  std::vector<CellFace> skin;
  for (std::size_t i = 0; i < faces.size();)
  {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].key == faces[i].key)
      ++end;
    if (end - i > 2)
      throw std::invalid_argument(head + ": " + std::to_string(end - i) +
                                  " cells share one face; the mesh overlaps itself: unite the solids and mesh again.");
    if (end - i == 2)
      parent[root(parent, faces[i].cell)] = root(parent, faces[i + 1].cell);
    else
      skin.push_back(faces[i]);
    i = end;
  }
  std::sort(skin.begin(), skin.end(),
            [](auto &a, auto &b) { return std::tie(a.cell, a.face) < std::tie(b.cell, b.face); });
  return skin;
}

void check_one_body(const Mesh &mesh, std::vector<int> &parent, const std::string &head)
{
  std::map<int, std::pair<std::size_t, std::set<int>>> bodies; // root to number of cells, solids
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
  {
    auto &[n, solids] = bodies[root(parent, static_cast<int>(c))];
    ++n;
    solids.insert(mesh.cell_solid[c]);
  }
  if (bodies.size() <= 1)
    return;
  std::string list;
  std::size_t shown = 0;
  for (const auto &[cell, body] : bodies)
    if (++shown <= 10)
    {
      list += "\n  " + std::to_string(body.first) + " cells of";
      for (const int solid : body.second)
        list += " \"" + mesh.solids[solid] + "\"";
      list += ", one at " + text(mesh.points[mesh.cells[cell][0]]) + " m";
    }
  throw std::invalid_argument(head + ": the mesh consists of " + std::to_string(bodies.size()) +
                              " bodies that do not hang together by common faces of cells (solids that only touch must "
                              "share their nodes: unite or fragment them before meshing):" +
                              list);
}

} // namespace

ExtractedMesh extract_mesh(const CadModel &model, const std::string &head, Bodies bodies)
{
  if (holds_hexahedra(model))
    return extract_hexahedra(model, head);
  ExtractedMesh result;
  Mesh         &mesh = result.mesh;
  Nodes         nodes;
  read_cells(model, head, nodes, mesh);
  result.node = nodes.tags();

  std::vector<int> parent(mesh.cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const std::vector<CellFace> skin = join(sorted_faces(mesh), parent, head);
  if (bodies == Bodies::one)
    check_one_body(mesh, parent, head);

  std::map<Triangle, int> surface_of; // sorted triangle to tag
  gmsh::vectorpair        surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto &[dim, tag] : surfaces)
    for_each_simplex(
        2, tag, head,
        [&, tag = tag](const std::size_t *corner) {
          surface_of[sorted({nodes.index(corner[0]), nodes.index(corner[1]), nodes.index(corner[2])})] = tag;
        });
  for (const CellFace &face : skin)
  {
    const auto &[i, j, k] = outward[face.face];
    const auto &cell      = mesh.cells[face.cell];
    const auto  surface   = surface_of.find(face.key);
    mesh.skin.push_back({cell[i], cell[j], cell[k]});
    result.skin_surface.push_back(surface == surface_of.end() ? 0 : surface->second);
  }
  return result;
}

} // namespace gestell::fem
