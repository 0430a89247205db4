#pragma once

#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

namespace gestell::fem
{

/**
 * The motions that free_motions() names of a frame with nothing held, as displacements of its coordinates [n x k],
 * independent of each other: of each part that nothing connects with others its own, zero elsewhere.
 *
 * @param frame with rigid_motions; otherwise the result has no columns.
 */
Eigen::MatrixXd free_displacements(const FrameMatrices &frame);

} // namespace gestell::fem
