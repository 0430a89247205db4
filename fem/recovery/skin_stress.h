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

/// Nodes of the quadratic mesh that a support or an interface holds rigid, with the name of that.
using RigidNodes = std::vector<std::pair<std::string, std::vector<int>>>;

/**
 * The stress at the corners of the skin, as an operator on q.
 *
 * In a quadratic tetrahedron with straight sides the gradient of the displacement is linear.  The line through the
 * points of Gauss, from which finite element programs extrapolate to the corners, is therefore the field itself, and it
 * is taken at the corner directly.  In a hexahedron it is carried on to the corners trilinearly from the 2 x 2 x 2
 * points of Gauss, where it is best; in a prism from 3 points of the triangle times 2 of Gauss, linearly in each. Cells
 * of one material that meet in a point are averaged by their volumes, cells of different materials never.  The error
 * falls with the square of the size of the cells, and a displacement that is quadratic in x, so that the stress is
 * linear, has none.
 *
 * @param material_of  of a cell.
 */
StressRecovery skin_stress(const QuadraticMesh &mesh, const std::function<const Material &(int)> &material_of,
                           const AffineConstraints &affine, const RigidNodes &rigid);

} // namespace gestell::fem
