#include "fem/mesh/solids/joined_meshes.h"

#include "fem/mesh/joined_cells.h"
#include "fem/values/vector3.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

/// Solids on both sides of the faces between two.
std::map<int, std::vector<int>> solids_at_faces(const CadModel &model)
{
  std::map<int, std::vector<int>> solids;
  for (std::size_t i = 0; i < model.solids.size(); ++i)
    for (const int face : model.solids[i].faces)
      solids[face].push_back(static_cast<int>(i));
  return solids;
}

/// Boxes around cells and faces.
struct BoxAround
{
  Vector3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const Vector3 &x)
  {
    for (int d = 0; d < 3; ++d)
    {
      low[d]  = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  }
  bool meets(const BoxAround &other, double tolerance) const
  {
    for (int d = 0; d < 3; ++d)
      if (low[d] > other.high[d] + tolerance || other.low[d] > high[d] + tolerance)
        return false;
    return true;
  }
};

/// Collects the cells of one kind after the other, as Mesh numbers them.
class Joining
{
public:
  Joining(const CadModel &model, const std::vector<PartialMesh> &meshes) : model_(model), meshes_(meshes)
  {
    for (const MeshContact &contact : contacts_of(model, meshes))
      if (contact.mesh[0] >= 0 && contact.mesh[1] >= 0)
        contacts_[contact.face] = contact;
  }

  ExtractedMesh mesh()
  {
    Mesh &all = result_.mesh;
    for (const Solid &solid : model_.solids)
      all.solids.push_back(solid.name);
    for (const PartialMesh &own : meshes_)
    {
      first_point_.push_back(static_cast<int>(all.points.size()));
      const Mesh &mesh = own.extracted.mesh;
      all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
    }
    add_cells(&Mesh::cells);
    add_cells(&Mesh::hexahedra);
    add_cells(&Mesh::prisms);
    add_middles();
    add_skin();
    for (auto &[meshes, tie] : ties_)
    {
      choose_cells(meshes.second, tie);
      all.ties.push_back(std::move(tie));
    }
    return std::move(result_);
  }

private:
  template <std::size_t n>
  void add_cells(std::vector<std::array<int, n>> Mesh::*kind)
  {
    Mesh &all = result_.mesh;
    for (std::size_t m = 0; m < meshes_.size(); ++m)
    {
      const Mesh &mesh        = meshes_[m].extracted.mesh;
      const int first_of_kind = static_cast<int>(n == 4 ? 0 : mesh.cells.size() + (n == 6 ? mesh.hexahedra.size() : 0));
      for (std::size_t i = 0; i < (mesh.*kind).size(); ++i)
      {
        (all.*kind).push_back((mesh.*kind)[i]);
        for (int &corner : (all.*kind).back())
          corner += first_point_[m];
        const int local = first_of_kind + static_cast<int>(i);
        cells_[m].push_back(static_cast<int>(all.cell_solid.size()));
        all.cell_solid.push_back(meshes_[m].solids[mesh.cell_solid[local]]);
      }
    }
  }

  void add_middles()
  {
    for (std::size_t m = 0; m < meshes_.size(); ++m)
      for (const auto &[edge, middle] : meshes_[m].extracted.mesh.middles)
        result_.mesh.middles[{edge[0] + first_point_[m], edge[1] + first_point_[m]}] = middle;
  }

  /// Quadrilaterals of all meshes, with their halves, then triangles.
  void add_skin()
  {
    Mesh &all = result_.mesh;
    for (std::size_t m = 0; m < meshes_.size(); ++m)
    {
      const auto &[mesh, surface, node] = meshes_[m].extracted;
      for (std::size_t q = 0; q < mesh.skin_quads.size(); ++q)
      {
        const auto [a, b, c, d] = moved(mesh.skin_quads[q], first_point_[m]);
        if (is_contact(static_cast<int>(m), surface[2 * q], {a, b, c, d}))
          continue;
        all.skin_quads.push_back({a, b, c, d});
        all.skin.push_back({a, b, c});
        all.skin.push_back({a, c, d});
        result_.skin_surface.insert(result_.skin_surface.end(), 2, surface[2 * q]);
      }
    }
    for (std::size_t m = 0; m < meshes_.size(); ++m)
    {
      const auto &[mesh, surface, node] = meshes_[m].extracted;
      for (std::size_t t = 2 * mesh.skin_quads.size(); t < mesh.skin.size(); ++t)
      {
        const auto [a, b, c] = moved(mesh.skin[t], first_point_[m]);
        if (is_contact(static_cast<int>(m), surface[t], {a, b, c, -1}))
          continue;
        all.skin.push_back({a, b, c});
        result_.skin_surface.push_back(surface[t]);
      }
    }
  }

  template <std::size_t n>
  static std::array<int, n> moved(std::array<int, n> corners, int by)
  {
    for (int &corner : corners)
      corner += by;
    return corners;
  }

  /// Whether the face is on another mesh; ties it if that leads.
  bool is_contact(int mesh, int surface, const std::array<int, 4> &corners)
  {
    const auto found = contacts_.find(surface);
    if (found == contacts_.end())
      return false;
    const MeshContact &contact = found->second;
    const int          side = contact.mesh[0] == mesh ? 0 : 1, leader = contact.mesh[1 - side];
    if (leader < mesh)
    {
      MeshTie &tie = ties_[{mesh, leader}];
      tie.faces.push_back(corners);
      tie.solids = {model_.solids[contact.solid[side]].name, model_.solids[contact.solid[1 - side]].name};
    }
    return true;
  }

  /// Cells of a mesh near the faces.
  void choose_cells(int leader, MeshTie &tie)
  {
    const Mesh &all = result_.mesh;
    BoxAround   faces;
    for (const auto &corners : tie.faces)
      for (const int corner : corners)
        if (corner >= 0)
          faces.add(all.points[corner]);
    constexpr double polygon = 0.05; // of the extent: by which polygons of both sides may differ
    for (const int cell : cells_[leader])
    {
      BoxAround box;
      for (int k = 0; k < cell_shape(all.kind(cell)).n_corners; ++k)
        box.add(all.points[all.corners(cell)[k]]);
      if (box.meets(faces, polygon * norm(faces.high - faces.low)))
        tie.cells.push_back(cell);
    }
  }

  const CadModel                        &model_;
  const std::vector<PartialMesh>        &meshes_;
  std::map<int, MeshContact>             contacts_; // by face
  std::vector<int>                       first_point_;
  std::map<int, std::vector<int>>        cells_; // of each mesh, as in the result
  std::map<std::pair<int, int>, MeshTie> ties_;  // by the meshes of faces and cells
  ExtractedMesh                          result_;
};

/// Solids that hang together by common faces.
void check_bodies(const CadModel &model, const Mesh &mesh, int wanted, const std::string &head)
{
  std::vector<int> parent(model.solids.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto &[face, solids] : solids_at_faces(model))
    for (const int solid : solids)
      parent[root(parent, solid)] = root(parent, solids.front());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parent.size(); ++i)
    if (root(parent, static_cast<int>(i)) == static_cast<int>(i))
      names.push_back("\"" + model.solids[i].name + "\"");
  const int found = static_cast<int>(names.size());
  if (wanted == 0 || found == wanted)
    return;
  throw std::invalid_argument(head + ": the mesh consists of " + std::to_string(found) + " bodies, one with solid " +
                              names.front() + (found > 1 ? " and one with solid " + names.back() : "") +
                              ", without common faces, but mesh.bodies = " + std::to_string(wanted) +
                              (found > wanted ? touching_nodes(mesh) + "; unite solids, or set it to that number."
                                              : "; set it to that number."));
}

} // namespace

std::vector<MeshContact> contacts_of(const CadModel &model, const std::vector<PartialMesh> &meshes)
{
  std::vector<int> mesh_of(model.solids.size(), -1);
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (const int solid : meshes[m].solids)
      mesh_of[solid] = static_cast<int>(m);
  std::vector<MeshContact> contacts;
  for (const auto &[face, solids] : solids_at_faces(model))
    if (solids.size() == 2 && mesh_of[solids[0]] != mesh_of[solids[1]])
      contacts.push_back({face, {solids[0], solids[1]}, {mesh_of[solids[0]], mesh_of[solids[1]]}});
  return contacts;
}

double area_on(const ExtractedMesh &extracted, int face)
{
  double area = 0.;
  for (std::size_t t = 0; t < extracted.mesh.skin.size(); ++t)
    if (extracted.skin_surface[t] == face)
    {
      const auto &[a, b, c] = extracted.mesh.skin[t];
      const auto &x         = extracted.mesh.points;
      area += 0.5 * norm(cross(x[b] - x[a], x[c] - x[a]));
    }
  return area;
}

ExtractedMesh joined(const CadModel &model, const std::vector<PartialMesh> &meshes, int bodies, const std::string &head)
{
  ExtractedMesh result = Joining(model, meshes).mesh();
  check_bodies(model, result.mesh, bodies, head);
  return result;
}

} // namespace gestell::fem
