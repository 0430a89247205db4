#include "fem/mesh/mesher.h"

#include "fem/geometry/read_cad.h"
#include "fem/mesh/frame_mesher.h"
#include "fem/mesh/gmsh_child.h"
#include "fem/values/mesh_phase.h"

namespace gestell::fem
{

template <typename Archive>
void exchange(Archive &archive, MeshTie &tie)
{
  auto &[faces, cells, solids] = tie;
  archive(faces, cells, solids);
}

template <typename Archive>
void exchange(Archive &archive, Mesh &mesh)
{
  auto &[points, cells, hexahedra, prisms, cell_solid, skin, skin_quads, solids, densities, middles, ties,
         takes_one_size, notes, statements, surfaces] = mesh;
  archive(points, cells, hexahedra, prisms, cell_solid, skin, skin_quads, solids, densities, middles, ties,
          takes_one_size, notes, statements, surfaces);
}

template <typename Archive>
void exchange(Archive &archive, ExtractedMesh &extracted)
{
  auto &[mesh, skin_surface, node] = extracted;
  archive(mesh, skin_surface, node);
}

template <typename Archive>
void exchange(Archive &archive, Solid &solid)
{
  auto &[tag, name, volume, min, max, faces, material, density] = solid;
  archive(tag, name, volume, min, max, faces, material, density);
}

template <typename Archive>
void exchange(Archive &archive, Face::Sample &sample)
{
  auto &[point, normal] = sample;
  archive(point, normal);
}

template <typename Archive>
void exchange(Archive &archive, Face &face)
{
  auto &[tag, kind, type, name, groups, edges, area, min, max, centre, direction, through, radius, faceted, samples] =
      face;
  archive(tag, kind, type, name, groups, edges, area, min, max, centre, direction, through, radius, faceted, samples);
}

template <typename Archive>
void exchange(Archive &archive, WallThickness &walls)
{
  auto &[thinnest, median_ratio, thin_share] = walls;
  archive(thinnest, median_ratio, thin_share);
}

template <typename Archive>
void exchange(Archive &archive, GeometryReport &report)
{
  auto &[solids, faces, surfaces, min, max, size, n_points, n_cells, n_coordinates, volume, worst_quality, mean_quality,
         expected_cells, smallest, walls, n_of_kind, notes, statements, extracted] = report;
  archive(solids, faces, surfaces, min, max, size, n_points, n_cells, n_coordinates, volume, worst_quality,
          mean_quality, expected_cells, smallest, walls, n_of_kind, notes, statements, extracted);
}

Mesh make_mesh(const FrameSpecification &specification, const MeshProgress &progress,
               const std::vector<SizePoint> &refined)
{
  return meshed_in_child<Mesh>(specification, progress,
                               [&](const MeshAttempt &attempt, const ChildProgress &on_progress)
                               { return mesh_of_frame(attempt, on_progress, refined); });
}

GeometryReport report_geometry(const FrameSpecification &specification, const MeshProgress &progress)
{
  return meshed_in_child<GeometryReport>(specification, progress, report_of_frame);
}

GeometryReport inspect_geometry(const FrameSpecification &specification)
{
  return in_gmsh_child<GeometryReport>(source_of(specification), mesh_phase::reading, {},
                                       [&](const ChildProgress &) { return inspection_of_frame(specification); });
}

} // namespace gestell::fem
