#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/substructures/frame_of_parts.h"
#include "coupling/substructures/part_union.h"
#include "fem/values/stress_recovery.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Stress of a part placed in the frame: sigma = Q sigma_part Q^T at every point, in q_part = S q and g_part = Q^T g.
void turn_stress(ReducedStress &stress, const Eigen::Matrix3d &Q, const Eigen::MatrixXd &S);

/**
 * Stresses of all parts by the coordinates of the joined frame,  sigma_i = S_i [G_i q_j; g],  points in the order of
 * the joined picture; empty unless every part has stresses.
 *
 * @param parts  in their positions, see placed().
 * @param G      [n x n_j] of all coordinates by those of the joined frame.
 */
fem::StressRecovery stress_of_parts(const std::vector<ReducedFrame> &parts, const FrameOfParts &description,
                                    const PartUnion &all, const Eigen::MatrixXd &G);

} // namespace gestell::coupling
