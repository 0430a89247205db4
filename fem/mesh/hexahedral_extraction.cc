#include "fem/mesh/hexahedral_extraction.h"

#include "fem/mesh/gmsh_elements.h"
#include "fem/mesh/hexahedral_mesh.h"
#include "fem/mesh/hexahedron.h"
#include "fem/mesh/mesh_nodes.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace gestell::fem
{

namespace
{

using Quad = std::array<int, 4>;

constexpr double straight = 1e-5; // of the size of a cell: digits of files

/// Calls visit(corners, their number) for every element of an entity.
template <typename Visit>
void for_each_element(int dim, int tag, const Visit &visit)
{
  for (const GmshElements &elements : elements_of(dim, tag))
    for (std::size_t j = 0; j < elements.nodes.size(); j += static_cast<std::size_t>(elements.n_nodes))
      visit(&elements.nodes[j], elements.n_corners);
}

void read_cells(const CadModel &model, const std::string &head, MeshNodes &nodes, Mesh &mesh)
{
  for (const Solid &solid : model.solids)
  {
    const std::size_t before = mesh.hexahedra.size();
    for_each_element(3, solid.tag,
                     [&](const std::size_t *corner, int)
                     {
                       std::array<int, 8> cell;
                       for (int i = 0; i < 8; ++i)
                         cell[i] = nodes.index(corner[i], mesh.points, head);
                       if (corner_quality(mesh, cell) < 0.) // mirrored
                         for (int i = 0; i < 4; ++i)
                           std::swap(cell[i], cell[i + 4]);
                       mesh.hexahedra.push_back(cell);
                     });
    if (mesh.hexahedra.size() == before)
      throw std::invalid_argument(head + ": solid \"" + solid.name +
                                  "\" has no volume mesh; mesh it in 3D before saving, and save all elements.");
    mesh.cell_solid.resize(mesh.hexahedra.size(), static_cast<int>(mesh.solids.size()));
    mesh.solids.push_back(solid.name);
  }
}

/// Of a node between corners: how far it lies from where the trilinear map of the corners sends it.
struct Offset
{
  double length = 0.; ///< [m]
  double share  = 0.; ///< of the longest diagonal of its cell
  bool   counts() const { return share > straight; }
};

/// Where the trilinear map of eight corners sends a point of the reference cell [-1, 1]^3.
Point3 trilinear(const std::array<Point3, 8> &corner, const double *local_corners, const double *local)
{
  Point3 result{};
  for (int i = 0; i < 8; ++i)
  {
    double N = 0.125;
    for (int d = 0; d < 3; ++d)
      N *= 1. + local_corners[3 * i + d] * local[d];
    result = result + N * corner[i];
  }
  return result;
}

/// The largest of hexahedra of higher order; cells are made of their corners alone.
Offset largest_offset(const CadModel &model, const std::string &head, const MeshNodes &nodes)
{
  Offset largest;
  for (const Solid &solid : model.solids)
    for (const auto &[n, n_corners, local, tags] : elements_of(3, solid.tag))
    {
      if (n_corners != 8 || n == n_corners)
        continue;
      for (std::size_t j = 0; j < tags.size(); j += static_cast<std::size_t>(n))
      {
        std::array<Point3, 8> corner;
        double                diagonal = 0.;
        for (int k = 0; k < 8; ++k)
        {
          corner[k] = nodes.position(tags[j + k], head);
          diagonal  = std::max(diagonal, norm(corner[k] - corner[0]));
        }
        for (int k = 8; k < n; ++k)
        {
          const double length =
              norm(nodes.position(tags[j + k], head) - trilinear(corner, local.data(), &local[3 * k]));
          largest.length = std::max(largest.length, length);
          largest.share  = std::max(largest.share, length / diagonal);
        }
      }
    }
  return largest;
}

void note_straight_sides(const Offset &offset, Mesh &mesh)
{
  if (!offset.counts())
    return;
  mesh.notes.push_back(
      "hexahedra are taken with straight edges between their corners: the nodes between them lie up to " +
      text(1e3 * offset.length) + " mm (" + text(100. * offset.share) +
      " % of the size of a cell) beside; make cells smaller along curved faces, or mesh with "
      "tetrahedra, whose sides may be curved");
}

struct CellFace
{
  Quad key;
  int  cell, face;
};

Quad sorted(Quad quad)
{
  std::sort(quad.begin(), quad.end());
  return quad;
}

Quad corners_of(const Mesh &mesh, const CellFace &face)
{
  Quad quad{};
  for (int k = 0; k < 4; ++k)
    quad[k] = mesh.hexahedra[face.cell][hexahedron::faces[face.face][k]];
  return quad;
}

int root(std::vector<int> &parent, int i)
{
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}

/// Faces of one cell only; `parent` joins cells that share one.
std::vector<CellFace> outer_faces(const Mesh &mesh, std::vector<int> &parent, const std::string &head)
{
  std::vector<CellFace> faces;
  for (int cell = 0; cell < static_cast<int>(mesh.hexahedra.size()); ++cell)
    for (int f = 0; f < 6; ++f)
    {
      faces.push_back({{}, cell, f});
      faces.back().key = sorted(corners_of(mesh, faces.back()));
    }
  std::sort(faces.begin(), faces.end(),
            [](const CellFace &a, const CellFace &b)
            { return std::tie(a.key, a.cell, a.face) < std::tie(b.key, b.cell, b.face); });

  std::vector<CellFace> outer;
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
      outer.push_back(faces[i]);
    i = end;
  }
  std::sort(outer.begin(), outer.end(),
            [](const CellFace &a, const CellFace &b) { return std::tie(a.cell, a.face) < std::tie(b.cell, b.face); });
  return outer;
}

void check_bodies(const Mesh &mesh, std::vector<int> &parent, int wanted, const std::string &head)
{
  std::map<int, int> first; // root of each body to one of its cells
  for (int cell = 0; cell < static_cast<int>(mesh.hexahedra.size()); ++cell)
    first.try_emplace(root(parent, cell), cell);
  const int found = static_cast<int>(first.size());
  if (found == wanted || wanted == 0)
    return;
  const auto at = [&](int cell) { return text(mesh.points[mesh.hexahedra[cell][0]]) + " m"; };
  throw std::invalid_argument(
      head + ": the mesh consists of " + std::to_string(found) + " bodies, one at " + at(first.begin()->second) +
      (found > 1 ? " and one at " + at(std::next(first.begin())->second) : "") +
      ", that do not hang together by common faces of cells, but mesh.bodies = " + std::to_string(wanted) +
      (found > wanted ? touching_nodes(mesh) +
                            "; fragment solids before meshing, and give edges that lie upon each other the same number "
                            "of nodes."
                      : "; set it to that number."));
}

} // namespace

ExtractedMesh extract_hexahedra(const CadModel &model, const std::string &head, const ExtractionOptions &options)
{
  ExtractedMesh result;
  Mesh         &mesh = result.mesh;
  MeshNodes     nodes(model.unit, options.gap, head);
  read_cells(model, head, nodes, mesh);
  note_straight_sides(largest_offset(model, head, nodes), mesh);
  result.node = nodes.tags();

  std::vector<int> parent(mesh.hexahedra.size());
  std::iota(parent.begin(), parent.end(), 0);
  const std::vector<CellFace> outer = outer_faces(mesh, parent, head);
  check_bodies(mesh, parent, options.bodies, head);
  if (model.meshed)
    note_nodes(mesh, nodes);

  const MeshNodes    &known = nodes;
  std::map<Quad, int> surface_of; // sorted corners to tag
  gmsh::vectorpair    surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto &entity : surfaces)
    for_each_element(2, entity.second,
                     [&](const std::size_t *corner, int n_corners)
                     {
                       if (n_corners == 4)
                         surface_of[sorted({known.index(corner[0]), known.index(corner[1]), known.index(corner[2]),
                                            known.index(corner[3])})] = entity.second;
                     });
  for (const CellFace &face : outer)
  {
    const Quad quad    = corners_of(mesh, face);
    const auto surface = surface_of.find(face.key);
    mesh.skin_quads.push_back(quad);
    mesh.skin.push_back({quad[0], quad[1], quad[2]});
    mesh.skin.push_back({quad[0], quad[2], quad[3]});
    result.skin_surface.insert(result.skin_surface.end(), 2, surface == surface_of.end() ? 0 : surface->second);
  }
  return result;
}

} // namespace gestell::fem
