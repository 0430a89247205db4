#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

namespace gestell::fem
{

/**
 * Force through a plane, "cut.NAME" [N], tension positive: with n the unit normal,
 *
 *     F = - n . sum_i (C_above u)_i
 *
 * C_above holds the cells whose centroid lies on the side n points to, i runs over the nodes they share with the
 * others. C_above u at these nodes is what the part below does to the part above, F the component in n of the opposite.
 * A translation of the cells above costs nothing, so this is the sum of all loads in n that act on their other nodes:
 * equilibrium holds exactly for any mesh and plane.  The weight of what lies between these nodes and the plane, cells
 * taken as straight, is added, so that at rest F carries what is above the plane; its inertia is not.  Damping after
 * Rayleigh adds beta C_above u' in the same way; its alpha M u', like inertia, acts on the masses from outside and is
 * no force within the frame, and damping by modal ratios belongs to no cell.  A force that a rigid interface or a
 * support carries across the plane by itself is not contained.
 *
 * @param rayleigh_stiffness  beta [s] of all cells.
 * @throws std::invalid_argument for a normal of no length and for a plane that does not divide the frame.
 */
FrameOutput cut_force(const CutSpecification &cut, const QuadraticMesh &mesh, const CellMaterials &materials,
                      const AffineConstraints &affine, double rayleigh_stiffness);

} // namespace gestell::fem
