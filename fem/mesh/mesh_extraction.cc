#include "fem/mesh/mesh_extraction.h"

#include "fem/geometry/cad_model.h"
#include "fem/mesh/gmsh_elements.h"
#include "fem/mesh/joined_cells.h"
#include "fem/mesh/mesh_nodes.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/mesh/mixed_extraction.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

namespace gestell::fem
{

namespace
{

/// Number of cells by number of corners, which identifies their kind.
std::map<int, std::size_t> count_by_corners(const CadModel &model)
{
  std::map<int, std::size_t> count;
  for (const Solid &solid : model.solids)
    for (const GmshElements &elements : elements_of(3, solid.tag))
      count[elements.n_corners] += elements.count();
  return count;
}

constexpr int tetrahedron = 4, pyramid = 5, prism = 6, hexahedron = 8; // corners

std::string in_words(const std::map<int, std::size_t> &count)
{
  static const std::map<int, std::string> names = {
      {tetrahedron, "tetrahedra"}, {hexahedron, "hexahedra"}, {prism, "prisms (wedges)"}, {pyramid, "pyramids"}};
  std::string words;
  std::size_t left = count.size();
  for (const auto &[n_corners, n] : count)
  {
    const auto name = names.find(n_corners);
    words += (words.empty() ? ""
              : left == 1   ? " and "
                            : ", ") +
             std::to_string(n) + " " +
             (name == names.end() ? "cells of " + std::to_string(n_corners) + " corners" : name->second);
    --left;
  }
  return words;
}

/**
 * Whether the solids of gmsh's mesh consist of tetrahedra only (or have no cells). Hexahedra, prisms, and prisms with
 * tetrahedra or hexahedra are the alternative.
 *
 * @throws std::invalid_argument with the number of cells of each kind for other combinations.
 */
bool only_tetrahedra(const CadModel &model, const std::string &head)
{
  const auto count = count_by_corners(model);
  const auto holds = [&](int corners) { return count.count(corners) > 0; };
  bool       known = true;
  for (const auto &[corners, n] : count)
    known = known && (corners == tetrahedron || corners == prism || corners == hexahedron);
  if (known && (!holds(tetrahedron) || !holds(hexahedron) || holds(prism)))
    return !holds(prism) && !holds(hexahedron);
  throw std::invalid_argument(
      head + " holds " + in_words(count) +
      ", but a mesh must consist of tetrahedra, of hexahedra or of prisms, or combine prisms with one of the others: "
      "there is no quadratic pyramid between tetrahedra and hexahedra. Mesh it with tetrahedra only (gmsh: without "
      "Recombine; Abaqus: "
      "C3D10), "
      "or extruded in Layers: hexahedra from quadrilaterals, prisms from triangles, with Recombine (Abaqus: C3D20, "
      "C3D15).");
}

using Triangle = std::array<int, 3>;

/// The four faces of a positively oriented cell, seen from outside, as cell_shape() counts them.
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

/// Edges on which the middle nodes of gmsh's quadratic tetrahedron lie.
constexpr std::array<std::array<int, 2>, 6> quadratic_edges = {{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}};

/// Calls visit(tags, their number) for every element of the entity; only simplices of the dimension are let through.
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
      visit(&nodes[i][j], n);
  }
}

/// Stores the middle nodes of edges of a quadratic tetrahedron that are not straight.
void keep_middles(Mesh &mesh, const std::array<int, 4> &cell, const std::size_t *tags, MeshNodes &nodes,
                  const std::string &head)
{
  for (int e = 0; e < 6; ++e)
  {
    const int        a = cell[quadratic_edges[e][0]], b = cell[quadratic_edges[e][1]];
    const Point3     middle        = nodes.position(tags[e], head);
    const Vector3    side          = mesh.points[b] - mesh.points[a];
    constexpr double straight_edge = 1e-6; // by which a middle may be off for rounding in files, of the edge
    if (norm(middle - 0.5 * (mesh.points[a] + mesh.points[b])) > straight_edge * norm(side))
      mesh.middles[{std::min(a, b), std::max(a, b)}] = middle;
  }
}

void read_cells(const CadModel &model, const std::string &head, MeshNodes &nodes, Mesh &mesh)
{
  for (const Solid &solid : model.solids)
  {
    const std::size_t before = mesh.cells.size();
    for_each_simplex(3, solid.tag, head,
                     [&](const std::size_t *corner, int n)
                     {
                       std::array<int, 4> cell;
                       for (int i = 0; i < 4; ++i)
                         cell[i] = nodes.index(corner[i], mesh.points, head);
                       if (n == 10)
                         keep_middles(mesh, cell, corner + 4, nodes, head);
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

void check_bodies(const Mesh &mesh, std::vector<int> &parent, int wanted, const std::string &head)
{
  std::map<int, std::pair<std::size_t, std::set<int>>> bodies; // root to number of cells, solids
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
  {
    auto &[n, solids] = bodies[root(parent, static_cast<int>(c))];
    ++n;
    solids.insert(mesh.cell_solid[c]);
  }
  const int found = static_cast<int>(bodies.size());
  if (found == wanted || wanted == 0)
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
  const std::string touching = found > wanted ? touching_nodes(mesh) : "";
  throw std::invalid_argument(head + ": the mesh consists of " + std::to_string(found) +
                              (found == 1 ? " body connected" : " bodies connected") +
                              " by common faces of cells, but mesh.bodies = " + std::to_string(wanted) +
                              (touching.empty() ? "; cells may be missing, as in a truncated file; set it to that "
                                                  "number if that is intended, or unite the solids before meshing:"
                                                : touching + ":") +
                              list);
}

} // namespace

ExtractedMesh extract_mesh(const CadModel &model, const std::string &head, const ExtractionOptions &options)
{
  if (!only_tetrahedra(model, head))
    return extract_mixed(model, head, options);
  ExtractedMesh result;
  Mesh         &mesh = result.mesh;
  MeshNodes     nodes(model.unit, options.gap, head);
  read_cells(model, head, nodes, mesh);
  result.node = nodes.tags();

  std::vector<int> parent(mesh.cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const std::vector<CellFace> faces = sorted_faces(mesh);
  const std::vector<CellFace> skin  = join_cells(faces, parent, head);
  require_unfolded(mesh, faces, head);
  check_bodies(mesh, parent, options.bodies, head);
  if (model.meshed)
    note_nodes(mesh, nodes);

  std::map<Triangle, int> surface_of; // sorted triangle to tag
  gmsh::vectorpair        surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto &[dim, tag] : surfaces)
    for_each_simplex(
        2, tag, head,
        [&, tag = tag](const std::size_t *corner, int) {
          surface_of[sorted({nodes.index(corner[0]), nodes.index(corner[1]), nodes.index(corner[2])})] = tag;
        });
  if (model.meshed)
    note_missing_cells(mesh, surface_of,
                       [&](const Triangle &key)
                       {
                         const auto face = std::lower_bound(faces.begin(), faces.end(), CellFace{key, -1, -1});
                         return face != faces.end() && face->key == key;
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
