#pragma once

#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

namespace gestell::fem
{

/**
 * Rigid-body modes of the unconstrained frame, as listed by free_motions(): linearly independent displacements of its
 * coordinates [n x k].  Each unconnected part has its own modes, which are zero elsewhere.
 *
 * @param frame  with rigid_motions; otherwise the result has no columns.
 */
Eigen::MatrixXd free_displacements(const FrameMatrices &frame);

} // namespace gestell::fem
