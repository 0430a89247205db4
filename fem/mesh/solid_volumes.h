#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/values/frame_specification.h"
#include "fem/values/mesh.h"

#include <vector>

namespace gestell::fem
{

/// Volumes of the solids of a mesh, with its curved sides [m^3].
std::vector<double> volumes_of_solids(const Mesh &mesh, std::size_t n_solids);

/// Adds a note for every solid whose mesh volume (and therefore its mass) differs from its geometry, because straight
/// sides of cells are chords of curved faces.
void note_volumes(Mesh &mesh, const std::vector<Solid> &solids, const MeshOptions &options);

/// Volumes and boxes of the solids of a mesh file without geometry.
void measure_solids(CadModel &model, const Mesh &mesh);

} // namespace gestell::fem
