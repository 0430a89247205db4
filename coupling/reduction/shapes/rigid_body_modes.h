#pragma once

#include "fem/values/frame_matrices.h"

#include <Eigen/SparseCore>

#include <vector>

namespace gestell::coupling
{

/**
 * Throws std::invalid_argument naming in words the motions that C does not resist ("translation along x", see
 * fem::free_motions(), or where the frame does not know its rigid motions the coordinate that moves most); returns if
 * there are none.
 *
 * A motion x counts as free if  x^T C x < 1e-13 x^T diag(C) x:  rounding of the assembly leaves about 1e-16, a machine
 * on soft springs some 1e-10.
 *
 * @param C  lower triangle of the stiffness with the interface held [n x n].
 */
void require_no_free_motion(const fem::FrameMatrices &frame, const std::vector<int> &q1,
                            const Eigen::SparseMatrix<double> &C);

} // namespace gestell::coupling
