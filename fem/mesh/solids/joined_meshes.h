#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <string>
#include <vector>

namespace gestell::fem
{

/// Mesh of some solids of a model, whose skin includes the faces at other solids.
struct PartialMesh
{
  ExtractedMesh    extracted; ///< solids are numbered as in `solids`
  std::vector<int> solids;    ///< of the model
};

/// A face between solids in two meshes.
struct MeshContact
{
  int                face = 0;
  std::array<int, 2> solid{}, mesh{}; ///< the mesh is -1 if none has the solid
};

/// Faces between solids in different meshes, or in a mesh and in none.
std::vector<MeshContact> contacts_of(const CadModel &model, const std::vector<PartialMesh> &meshes);

/// Area of the faces of cells on a face of the model [m^2].
double area_on(const ExtractedMesh &extracted, int face);

/**
 * One mesh from all, which have no common nodes: faces of a mesh that meets an earlier one are tied to it, and are not
 * in the skin, nor are those that they cover.
 *
 * @param bodies  expected number of connected bodies; 0: any
 * @throws std::invalid_argument for another number
 */
ExtractedMesh joined(const CadModel &model, const std::vector<PartialMesh> &meshes, int bodies,
                     const std::string &head);

} // namespace gestell::fem
