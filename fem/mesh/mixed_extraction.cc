#include "fem/mesh/mixed_extraction.h"

#include "fem/mesh/cell_measures.h"
#include "fem/mesh/gmsh_elements.h"
#include "fem/mesh/joined_cells.h"
#include "fem/mesh/mesh_nodes.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/values/cell_shape.h"
#include "fem/values/message_text.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <tuple>

namespace gestell::fem
{

namespace
{

using Key = std::array<int, 4>; // corners of a face, sorted; of a triangle the first is -1

constexpr double straight = 1e-5; // of the size of a cell: digits of files

/// Calls visit(corners, their number) for every element of an entity.
template <typename Visit>
void for_each_element(int dim, int tag, const Visit &visit)
{
  for (const GmshElements &elements : elements_of(dim, tag))
    for (std::size_t j = 0; j < elements.nodes.size(); j += static_cast<std::size_t>(elements.n_nodes))
      visit(&elements.nodes[j], elements.n_corners);
}

/// Cells of one kind, and their solids.
template <std::size_t n>
struct CellList
{
  std::vector<std::array<int, n>> &cells;
  std::vector<int>                 solid{};

  void add(const std::size_t *corners, int of_solid, MeshNodes &nodes, Mesh &mesh, const std::string &head)
  {
    std::array<int, n> cell;
    for (std::size_t i = 0; i < n; ++i)
      cell[i] = nodes.index(corners[i], mesh.points, head);
    cells.push_back(cell);
    solid.push_back(of_solid);
  }
};

/// Mirrored ones are turned.
void orient(Mesh &mesh)
{
  for (auto &cell : mesh.cells)
    if (six_volumes(mesh, cell) < 0.)
      std::swap(cell[2], cell[3]);
  for (int cell = static_cast<int>(mesh.cells.size()); cell < mesh.n_cells(); ++cell)
    if (corner_quality(mesh, cell) < 0.)
    {
      const std::size_t i = cell - mesh.cells.size();
      if (mesh.kind(cell) == CellKind::hexahedron)
        std::swap_ranges(mesh.hexahedra[i].begin(), mesh.hexahedra[i].begin() + 4, mesh.hexahedra[i].begin() + 4);
      else
      {
        auto &prism = mesh.prisms[i - mesh.hexahedra.size()];
        std::swap_ranges(prism.begin(), prism.begin() + 3, prism.begin() + 3);
      }
    }
}

void read_cells(const CadModel &model, const std::string &head, MeshNodes &nodes, Mesh &mesh)
{
  CellList<4> tetrahedra{mesh.cells};
  CellList<8> hexahedra{mesh.hexahedra};
  CellList<6> prisms{mesh.prisms};
  for (const Solid &solid : model.solids)
  {
    const int before = mesh.n_cells(), index = static_cast<int>(mesh.solids.size());
    for_each_element(3, solid.tag,
                     [&](const std::size_t *corners, int n_corners)
                     {
                       if (n_corners == 4)
                         tetrahedra.add(corners, index, nodes, mesh, head);
                       else if (n_corners == 8)
                         hexahedra.add(corners, index, nodes, mesh, head);
                       else
                         prisms.add(corners, index, nodes, mesh, head);
                     });
    if (mesh.n_cells() == before)
      throw std::invalid_argument(head + ": solid \"" + solid.name +
                                  "\" has no volume mesh; mesh it in 3D before saving, and save all elements.");
    mesh.solids.push_back(solid.name);
  }
  for (const auto *list : {&tetrahedra.solid, &hexahedra.solid, &prisms.solid})
    mesh.cell_solid.insert(mesh.cell_solid.end(), list->begin(), list->end());
  orient(mesh);
}

/// Distance of a middle node from its position on the cell with straight edges.
struct Offset
{
  double length = 0.; ///< [m]
  double share  = 0.; ///< of the longest diagonal of its cell
  bool   counts() const { return share > straight; }
};

/// N of a corner, whose place in gmsh's reference cell is known, at a point: of hexahedra on [-1, 1]^3 trilinear; of
/// tetrahedra and, times a line on [-1, 1], of the triangles of prisms linear.
double corner_function(int n_corners, const double *corner, const double *x)
{
  if (n_corners == 8)
    return 0.125 * (1. + corner[0] * x[0]) * (1. + corner[1] * x[1]) * (1. + corner[2] * x[2]);
  const int dim = n_corners == 4 ? 3 : 2;
  double    sum = 0., own = 0.;
  bool      apex = true;
  for (int d = 0; d < dim; ++d)
  {
    sum += x[d];
    own += corner[d] * x[d];
    apex = apex && corner[d] < 0.5;
  }
  const double L = apex ? 1. - sum : own;
  return dim == 3 ? L : L * 0.5 * (1. + corner[2] * x[2]);
}

Offset offset_of(const std::vector<Point3> &nodes, int n_corners, const std::vector<double> &local)
{
  double diagonal = 0.;
  for (int k = 0; k < n_corners; ++k)
    diagonal = std::max(diagonal, norm(nodes[k] - nodes[0]));
  Offset largest;
  for (std::size_t k = n_corners; k < nodes.size(); ++k)
  {
    Point3 x{};
    for (int i = 0; i < n_corners; ++i)
      x = x + corner_function(n_corners, &local[3 * i], &local[3 * k]) * nodes[i];
    const double length = norm(nodes[k] - x);
    largest.length      = std::max(largest.length, length);
    largest.share       = std::max(largest.share, length / diagonal);
  }
  return largest;
}

/// The largest offset in cells of higher order; this mesh uses only their corners.
Offset largest_offset(const CadModel &model, const std::string &head, const MeshNodes &nodes)
{
  Offset largest;
  for (const Solid &solid : model.solids)
    for (const auto &[n, n_corners, local, tags] : elements_of(3, solid.tag))
      for (std::size_t j = 0; n > n_corners && j < tags.size(); j += static_cast<std::size_t>(n))
      {
        std::vector<Point3> positions;
        for (int k = 0; k < n; ++k)
          positions.push_back(nodes.position(tags[j + k], head));
        const Offset offset = offset_of(positions, n_corners, local);
        largest.length      = std::max(largest.length, offset.length);
        largest.share       = std::max(largest.share, offset.share);
      }
  return largest;
}

void note_straight_sides(const Offset &offset, Mesh &mesh)
{
  if (!offset.counts())
    return;
  mesh.notes.push_back("hexahedra and prisms get straight edges between their corners: the middle nodes are up to " +
                       text(1e3 * offset.length) + " mm (" + text(100. * offset.share) +
                       " % of the size of a cell) off these edges; make cells smaller along curved faces, or mesh with "
                       "tetrahedra, which may have curved sides");
}

struct CellFace
{
  Key key;
  int cell, face;
};

Key key_of(const std::vector<int> &corners)
{
  Key key = {-1, -1, -1, -1};
  std::copy(corners.begin(), corners.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<int> corners_of(const Mesh &mesh, const CellFace &face)
{
  std::vector<int> corners = cell_shape(mesh.kind(face.cell)).faces[face.face];
  for (int &corner : corners)
    corner = mesh.corners(face.cell)[corner];
  return corners;
}

/// Faces of one cell only; `parent` joins cells that share one.
std::vector<CellFace> outer_faces(const Mesh &mesh, std::vector<int> &parent, const std::string &head)
{
  std::vector<CellFace> faces;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (std::size_t f = 0; f < cell_shape(mesh.kind(cell)).faces.size(); ++f)
    {
      faces.push_back({{}, cell, static_cast<int>(f)});
      faces.back().key = key_of(corners_of(mesh, faces.back()));
    }
  std::sort(faces.begin(), faces.end(),
            [](const CellFace &a, const CellFace &b)
            { return std::tie(a.key, a.cell, a.face) < std::tie(b.key, b.cell, b.face); });

  std::vector<CellFace> outer = join_cells(faces, parent, head);
  require_unfolded(mesh, faces, head);
  return outer;
}

void check_bodies(const Mesh &mesh, std::vector<int> &parent, int wanted, const std::string &head)
{
  std::map<int, int> first; // root of each body to one of its cells
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    first.try_emplace(root(parent, cell), cell);
  const int found = static_cast<int>(first.size());
  if (found == wanted || wanted == 0)
    return;
  const auto at = [&](int cell) { return text(mesh.points[mesh.corners(cell)[0]]) + " m"; };
  throw std::invalid_argument(
      head + ": the mesh consists of " + std::to_string(found) + " bodies, one at " + at(first.begin()->second) +
      (found > 1 ? " and one at " + at(std::next(first.begin())->second) : "") +
      ", without common faces of cells, but mesh.bodies = " + std::to_string(wanted) +
      (found > wanted ? touching_nodes(mesh) +
                            "; fragment solids before meshing, and give coincident edges the same number of nodes."
                      : "; set it to that number."));
}

/// Requires that no quadrilateral meets triangles, where displacements would be discontinuous.
void require_matching(const Mesh &mesh, const std::string &head)
{
  std::set<Key> halves;
  for (const auto &[a, b, c, d] : mesh.skin_quads)
    for (const std::vector<int> &half : {std::vector{a, b, c}, {b, c, d}, {c, d, a}, {d, a, b}})
      halves.insert(key_of(half));
  int n = 0, where = 0;
  for (std::size_t k = 2 * mesh.skin_quads.size(); k < mesh.skin.size(); ++k)
    if (const auto &[a, b, c] = mesh.skin[k]; halves.count(key_of({a, b, c})) > 0)
    {
      ++n;
      where = a;
    }
  if (n > 0)
    throw std::invalid_argument(head + ": " + std::to_string(n) +
                                " triangles of cells are on quadrilaterals of others, one at " +
                                text(mesh.points[where]) +
                                " m, where displacements would be discontinuous; connect tetrahedra to triangles of "
                                "prisms, and hexahedra to quadrilaterals, or mesh with tetrahedra only.");
}

/// Tags of gmsh's surfaces by the corners of their elements.
std::map<Key, int> surfaces_of(const MeshNodes &nodes)
{
  std::map<Key, int> surface_of;
  gmsh::vectorpair   surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto &entity : surfaces)
    for_each_element(2, entity.second,
                     [&](const std::size_t *corner, int n_corners)
                     {
                       std::vector<int> points;
                       for (int k = 0; k < n_corners; ++k)
                         points.push_back(nodes.index(corner[k]));
                       surface_of[key_of(points)] = entity.second;
                     });
  return surface_of;
}

void note_lost_cells(Mesh &mesh, const std::map<Key, int> &surface_of)
{
  std::set<Key> faces; // of cells, among the elements of surfaces
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (std::size_t f = 0; f < cell_shape(mesh.kind(cell)).faces.size(); ++f)
      if (const Key key = key_of(corners_of(mesh, {{}, cell, static_cast<int>(f)})); surface_of.count(key) > 0)
        faces.insert(key);
  note_missing_cells(mesh, surface_of, [&](const Key &key) { return faces.count(key) > 0; });
}

/// Quadrilaterals first, with their halves, then triangles.
void add_skin(const std::vector<CellFace> &outer, const SurfaceOf &surface_of, ExtractedMesh &result)
{
  Mesh &mesh = result.mesh;
  for (const std::size_t n : {4u, 3u})
    for (const CellFace &face : outer)
    {
      const std::vector<int> corners = corners_of(mesh, face);
      if (corners.size() != n)
        continue;
      result.skin_surface.insert(result.skin_surface.end(), n - 2, surface_of(corners));
      mesh.skin.push_back({corners[0], corners[1], corners[2]});
      if (n == 3)
        continue;
      mesh.skin_quads.push_back({corners[0], corners[1], corners[2], corners[3]});
      mesh.skin.push_back({corners[0], corners[2], corners[3]});
    }
}

} // namespace

void add_skin(ExtractedMesh &result, const std::string &head, int bodies, const SurfaceOf &surface_of)
{
  Mesh            &mesh = result.mesh;
  std::vector<int> parent(mesh.n_cells());
  std::iota(parent.begin(), parent.end(), 0);
  const std::vector<CellFace> outer = outer_faces(mesh, parent, head);
  add_skin(outer, surface_of, result);
  require_matching(mesh, head);
  check_bodies(mesh, parent, bodies, head);
}

ExtractedMesh extract_mixed(const CadModel &model, const std::string &head, const ExtractionOptions &options)
{
  ExtractedMesh result;
  Mesh         &mesh = result.mesh;
  MeshNodes     nodes(model.unit, options.gap, head);
  read_cells(model, head, nodes, mesh);
  note_straight_sides(largest_offset(model, head, nodes), mesh);
  result.node                       = nodes.tags();
  const std::map<Key, int> surfaces = surfaces_of(nodes);
  add_skin(result, head, options.bodies,
           [&](const std::vector<int> &corners)
           {
             const auto surface = surfaces.find(key_of(corners));
             return surface == surfaces.end() ? 0 : surface->second;
           });
  if (model.meshed)
  {
    note_lost_cells(mesh, surfaces);
    note_nodes(mesh, nodes);
  }
  return result;
}

} // namespace gestell::fem
