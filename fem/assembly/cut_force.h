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
 * C_above is the stiffness of the cells with the centroid on the side of n, i runs over the nodes that they share with
 * the others. C_above u at these nodes is the force of the part below on the part above, F the component along n of its
 * opposite. A translation of the cells above has no energy, so F is the sum of all loads along n on their other nodes:
 * exact equilibrium for any mesh and plane.  The weight between these nodes and the plane (straight cells) is added, so
 * that at rest F is the weight above the plane; its inertia is not.  Rayleigh damping adds beta C_above u' in the same
 * way; alpha M u', like inertia, is external and not an internal force; modal damping ratios have no force in cells.
 * The force carried across the plane by a rigid interface or a support is not included.
 *
 * @param rayleigh_stiffness  beta [s] of all cells.
 * @throws std::invalid_argument for a zero normal and for a plane that does not cut the frame.
 */
FrameOutput cut_force(const CutSpecification &cut, const QuadraticMesh &mesh, const CellMaterials &materials,
                      const AffineConstraints &affine, double rayleigh_stiffness);

} // namespace gestell::fem
