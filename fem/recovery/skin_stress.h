#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_specification.h"
#include "fem/values/stress_recovery.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

/// Nodes of the quadratic mesh on rigid supports or interfaces, with their names.
using RigidNodes = std::vector<std::pair<std::string, std::vector<int>>>;

/**
 * The stress at the corners of the skin, as an operator on q.
 *
 * In a quadratic tetrahedron with straight sides the gradient of the displacement is linear.  Extrapolation from the
 * Gauss points to the corners is therefore exact, and the gradient is evaluated at the corner directly. In a hexahedron
 * it is extrapolated trilinearly from the 2 x 2 x 2 superconvergent Gauss points; in a prism linearly from 3 points of
 * the triangle times 2 Gauss points. Cells of one material that meet in a point are averaged by their volumes, cells of
 * different materials never.  The error falls with the square of the cell size and is zero for displacements quadratic
 * in x (linear stress).
 *
 * @param material_of  of a cell.
 */
StressRecovery skin_stress(const QuadraticMesh &mesh, const std::function<const Material &(int)> &material_of,
                           const AffineConstraints &affine, const RigidNodes &rigid);

} // namespace gestell::fem
