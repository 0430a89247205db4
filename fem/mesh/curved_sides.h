#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <vector>

namespace gestell::fem
{

/**
 * Moves the middles of the edges on curved faces and curves of gmsh's geometry onto them: sides then follow bores and
 * fillets with an error of third order in the element size, instead of second order for straight sides.  On cylinders
 * the middle is moved along the radius, else to gmsh's nearest point.  Cells that would fold are straightened, see
 * unfold().
 */
void follow_geometry(ExtractedMesh &extracted, const CadModel &model);

/**
 * Straightens edges (by half, finally completely) until the determinant of dx/dxi of every cell is above a tenth of
 * that of the straight cell everywhere; the smallest Bernstein coefficient of its cubic is a lower bound. A note of the
 * mesh gives the number of edges.
 */
void unfold(Mesh &mesh);

/// Volumes of tetrahedra_of() the mesh, with curved sides [m^3].
std::vector<double> curved_volumes(const Mesh &mesh);

/// Volume of the cells with their curved sides [m^3], exact for straight ones.
double curved_volume(const Mesh &mesh);

} // namespace gestell::fem
