#pragma once

#include "fem/mesh/mesh_nodes.h"
#include "fem/values/mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gestell::fem
{

/// gmsh's mesh as a value, with the origin of its skin.
struct ExtractedMesh
{
  Mesh                     mesh;         ///< without named surfaces
  std::vector<int>         skin_surface; ///< for each triangle of the skin the tag of gmsh's surface, 0 if it has none
  std::vector<std::size_t> node;         ///< for each point gmsh's tag
};

struct ExtractionOptions
{
  int    bodies = 1;  ///< expected number of bodies connected by common faces of cells; 0: any
  double gap    = 0.; ///< nodes within this distance are merged [m]
};

/// Remark on touching bodies of a mesh: number of coincident nodes; "" for none.
std::string touching_nodes(const Mesh &mesh);

/// Notes on nodes that were merged, coincide with others, or are not part of a cell.
void note_nodes(Mesh &mesh, const MeshNodes &nodes);

} // namespace gestell::fem
