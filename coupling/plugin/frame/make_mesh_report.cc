#include "coupling/plugin/frame/make_mesh_report.h"

#include "coupling/plugin/frame/face_selector.h"
#include "coupling/plugin/frame/file_unit.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/mesher.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::coupling
{

namespace
{

/// Names a face bears: in the file, its groups, then those the specification gives it.
std::string names_of(const fem::Face &face, const std::map<std::string, std::vector<int>> &surfaces)
{
  std::string names = face.name;
  const auto  add   = [&](const std::string &name) { names += (names.empty() ? "" : ", ") + name; };
  for (const std::string &group : face.groups)
    add(group);
  for (const auto &[name, tags] : surfaces)
    if (std::find(tags.begin(), tags.end(), face.tag) != tags.end())
      add(name);
  return names;
}

/// The face as a selector would find it.
std::string shape_of(const fem::Face &face)
{
  switch (face.kind)
  {
  case fem::FaceKind::plane:
    return "plane, normal " + fem::text(face.direction) + ", through " + fem::text(face.through);
  case fem::FaceKind::cylinder:
    return "cylinder, axis " + fem::text(face.direction) + ", through " + fem::text(face.through) + ", radius " +
           fem::text(face.radius);
  case fem::FaceKind::other:
    break;
  }
  return face.type;
}

std::vector<std::string> features_of(const fem::GeometryReport &geometry)
{
  std::vector<std::string> lines;
  if (!geometry.smallest.empty())
    lines.push_back(geometry.smallest);
  if (const fem::WallThickness &walls = geometry.walls; walls.thin_share > 0.)
    lines.push_back(fem::text(std::round(100. * walls.thin_share)) +
                    " % of the surface belong to walls thinner than the elements, down to " +
                    fem::text(1e3 * walls.thinnest) + " mm; there elements are " + fem::text(walls.median_ratio) +
                    " times as large as the wall is thick (median)" +
                    (walls.median_ratio > 2. && geometry.n_of_kind[0] > 0
                         ? ": bending comes out too stiff, see gestell modes --converge"
                         : ""));
  return lines;
}

/// "tetrahedra", or of several kinds "cells (12 tetrahedra, 8 prisms)".
std::string kinds_of(const fem::GeometryReport &geometry)
{
  const std::array<std::string, 3> names = {"tetrahedra", "hexahedra", "prisms"};
  std::string                      counts, last;
  int                              n = 0;
  for (std::size_t kind = 0; kind < names.size(); ++kind)
    if (geometry.n_of_kind[kind] > 0)
    {
      counts += (n++ > 0 ? ", " : "") + std::to_string(geometry.n_of_kind[kind]) + " " + names[kind];
      last = names[kind];
    }
  return n == 1 ? last : "cells (" + counts + ")";
}

std::string kind_of(const fem::Face &face)
{
  return face.kind == fem::FaceKind::plane ? "plane" : face.kind == fem::FaceKind::cylinder ? "cylinder" : face.type;
}

/// Triangles of no face, between gmsh's surfaces, are left out.
FacePicture picture_of(const fem::GeometryReport &geometry)
{
  std::map<int, int> index;
  for (std::size_t i = 0; i < geometry.faces.size(); ++i)
    index[geometry.faces[i].tag] = static_cast<int>(i);
  const fem::Mesh &mesh = geometry.extracted.mesh;
  FacePicture      picture;
  std::vector<int> number(mesh.points.size(), -1);
  for (std::size_t t = 0; t < mesh.skin.size(); ++t)
  {
    const auto face = index.find(geometry.extracted.skin_surface[t]);
    if (face == index.end())
      continue;
    picture.face.push_back(face->second);
    picture.triangles.emplace_back();
    for (int k = 0; k < 3; ++k)
    {
      int &point = number[mesh.skin[t][k]];
      if (point < 0)
      {
        point = static_cast<int>(picture.points.size());
        picture.points.push_back(mesh.points[mesh.skin[t][k]]);
      }
      picture.triangles.back()[k] = point;
    }
  }
  return picture;
}

} // namespace

MeshReport mesh_report(const fem::FrameSpecification &frame, const Progress &progress)
{
  const fem::GeometryReport geometry = fem::report_geometry(frame, progress);
  MeshReport                report;
  report.n_points       = geometry.n_points;
  report.n_cells        = geometry.n_cells;
  report.n_coordinates  = geometry.n_coordinates;
  report.cells          = kinds_of(geometry);
  report.size           = geometry.size;
  report.volume         = geometry.volume;
  report.mass           = geometry.volume * frame.material.rho;
  report.worst_quality  = geometry.worst_quality;
  report.mean_quality   = geometry.mean_quality;
  report.expected_cells = geometry.expected_cells;
  report.memory =
      fem::reduction_memory(geometry.n_coordinates, fem::compactness(geometry.volume, fem::skin_area(geometry.faces)));
  report.available_memory = fem::available_memory();
  report.features         = features_of(geometry);
  report.notes            = geometry.notes;
  report.statements       = geometry.statements;
  for (const auto &solid : geometry.solids)
    report.solids.push_back({solid.name, solid.volume, solid.volume * frame.material.rho, solid.min, solid.max});
  double diagonal = 0.;
  for (int d = 0; d < 3; ++d)
    diagonal = std::hypot(diagonal, geometry.max[d] - geometry.min[d]);
  for (const auto &face : geometry.faces)
  {
    const FaceSelector own = selector_of(face, geometry.faces, diagonal);
    report.surfaces.push_back({face.tag, names_of(face, geometry.surfaces), shape_of(face), own.text, face.area,
                               face.min, face.max, face.centre, own.others, kind_of(face), face.direction, face.through,
                               face.radius});
  }
  report.picture = picture_of(geometry);
  report.unit    = file_unit(frame);
  return report;
}

} // namespace gestell::coupling
