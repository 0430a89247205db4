#pragma once

#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

namespace gestell::fem
{

/**
 * The stress at chosen points of the skin as outputs "stress.NAME.xx", ".yy", ".zz", ".xy", ".yz", ".xz" [Pa], tension
 * positive, and with a direction n "stress.NAME.normal",  n . sigma n.
 *
 * A point is moved to the nearest one of the skin.  There the stress is linear between the recovered values at the
 * corners of a triangle (StressRecovery): exact where the stress is, else with an error of the square of the size.
 *
 * @param recovery  of the frame, with its picture.
 * @param frame     receives the outputs, a statement with the distance of each point, and a note for points in cells at
 *                  a rigid surface.
 * @throws std::invalid_argument for a point farther from the skin than the longest side of the triangle there, and for
 * a direction of zero.
 */
void add_stress_points(const std::vector<StressPointSpecification> &points, const StressRecovery &recovery,
                       FrameMatrices &frame);

} // namespace gestell::fem
