#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <vector>

namespace gestell::fem
{

/**
 * Moves the middles of the edges on curved faces and curves of gmsh's geometry onto them: sides then follow bores and
 * fillets to third order of the element size, where straight ones stay behind by second order.  On cylinders the middle
 * is moved along the radius, else to gmsh's nearest point.  Cells that would fold are straightened, see unfold().
 */
void follow_geometry(ExtractedMesh &extracted, const CadModel &model);

/**
 * Straightens edges (half the way, at last wholly) until the determinant of dx/dxi of every cell stays above a tenth of
 * that of the straight cell everywhere: the least coefficient of its cubic in Bernstein's form is a bound from below.
 * A note of the mesh tells how many edges that were.
 */
void unfold(Mesh &mesh);

/// Volumes of the tetrahedra_of() the mesh with their curved sides [m^3].
std::vector<double> curved_volumes(const Mesh &mesh);

/// Volume of the cells with their curved sides [m^3], exact for straight ones.
double curved_volume(const Mesh &mesh);

} // namespace gestell::fem
