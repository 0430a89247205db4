#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_matrices.h"

namespace gestell::fem
{

/// Skin of the frame with its corners as points; tied corners move through their interfaces, held ones rest.
Picture skin_picture(const QuadraticMesh &mesh, const AffineConstraints &affine);

} // namespace gestell::fem
