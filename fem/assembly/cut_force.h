#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

#include <array>
#include <vector>

namespace gestell::fem
{

/**
 * Forces and moments of the section in a plane, of the part above on the part below: "cut.NAME" [N], the normal force,
 * tension positive, "cut.NAME.V1", ".V2" [N] along the axes e_1, e_2, and "cut.NAME.T", ".M1", ".M2" [N m] about n,
 * e_1, e_2 through the point c.  n is the unit normal, e_1 the first direction made perpendicular to it, e_2 = n x e_1.
 *
 * With w(x) = a for a force along a and w(x) = a x (x - c) for a moment about it,
 *
 *     F = sum_i v_i . (C u)_i,    v_i = w(x_i) at nodes of cells above only, 0 at the others,
 *
 * but at nodes of supports and of interfaces v = w above the plane.
 *
 * Above are the cells with the centroid on the side of n.  w has no energy in them, so F is the sum of w . f over the
 * loads f on the nodes above: exact equilibrium for any mesh and plane.  Nodes of tied faces follow the nodes they are
 * tied to.  Weight, inertia and alpha M u' of the mass between these nodes and the plane are added,
 *
 *     F += sum_i h_i . (g - u''_i - alpha u'_i),    h_i = int rho w N_i dV above the plane - (M v)_i,
 *
 * so that F is due to all of the mass above the plane.  In the part of a cell that the plane divides, u'' is replaced
 * by the linear field nearest to its nodal values: exact for rigid motions.  h and the centroid are exact for cells
 * with plane faces.  Rayleigh damping adds beta C u' as it adds C u; modal damping ratios have no force in cells.  A
 * rigid interface or a support that reaches to both sides carries force that is not included.  About a prestressed
 * state moments also contain the stresses above times their displacement relative to the section.
 *
 * @param supported  nodes of supports.
 * @param rayleigh   alpha [1/s] and beta [s] of all cells.
 * @throws std::invalid_argument for a zero normal, a first direction along it and a plane that does not cut the frame.
 */
std::vector<FrameOutput> cut_forces(const CutSpecification &cut, const QuadraticMesh &mesh,
                                    const CellMaterials &materials, const AffineConstraints &affine,
                                    const std::vector<int> &supported, const std::array<double, 2> &rayleigh);

} // namespace gestell::fem
