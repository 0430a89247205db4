#pragma once

#include "fem/frame_matrices.h"
#include "fem/kinematics.h"
#include "fem/quadratic_mesh.h"

namespace gestell::fem
{

/// Skin of the frame with its corners as points; tied corners move through their interfaces, held ones rest.
Picture skin_picture(const QuadraticMesh &mesh, const Kinematics &kinematics);

} // namespace gestell::fem
